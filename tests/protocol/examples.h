// Problems and motions to write and read.
#pragma once

#include <cstdint>
#include <random>
#include <string>

#include "common/motion.h"
#include "common/problem.h"

namespace spacetime::examples {

Input dof(std::string name, int derivative);
Input constant(std::string name);
Input parameter(std::string name);
Input functional(int index);
Input multiplier(int index);
Input time();

// Adds an operation.
void push(Program& program, Op op, std::int32_t a, std::int32_t b = 0, std::int32_t c = 0);
// Puts a program under its hash.
std::string add(Problem& problem, Program program);

// Small, and with at least one of everything that a problem can hold, but of actions those alone that statements need.
Problem rich_problem();
// Every action, with all its members and with as few as it can have.
Problem busy_problem();
Motion rich_motion();

// A valid program over the given inputs, with derivatives where it has unknowns; needs no meaning.
Program random_program(std::mt19937& random, std::vector<Input> inputs, int operations);

// Valid problems and motions of every shape, with numbers of every size.
Problem random_problem(std::uint32_t seed);
Motion random_motion(std::uint32_t seed);

// Any finite double: -0.0, denormals, the largest, integers, and whatever else 64 random bits make.
double random_number(std::mt19937& random);

}  // namespace spacetime::examples
