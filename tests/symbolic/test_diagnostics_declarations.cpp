// Wrong statements: declarations, constraints and objectives, creatures and scripts.
#include <string>
#include <vector>

#include "tests/symbolic/wrong.h"

namespace spacetime::symbolic {
namespace {

TEST(Diagnostics, Statements) {
  for (const Wrong& wrong : std::vector<Wrong>{
           {"constant g = 9.81", 1, 1, "the scene has no time"},
           {"time [0, 1]\ntime [0, 2]", 2, 1, "a scene has one 'time'"},
           {"time [2, 1]", 1, 6, "must end later"},
           {"time [0, 1/0]", 1, 11, "division by zero"},
           {"time [0, t]", 1, 10, "depends on time"},
           {"time [0, 1]\ndof x\ndof y", 2, 5, "'x' has no trajectory"},
           {"time [0, 1]\ntrajectory bspline spans 2.5\ndof x", 2, 26, "a whole number"},
           {"time [0, 1]\ntrajectory bspline spans 0", 2, 26, "a whole number from 1"},
           {"time [0, 1]\ntrajectory bspline knots [0, 0.5, 0.4, 1]", 2, 35, "knots must rise"},
           {"time [0, 1]\ntrajectory bspline knots [0, 0.5, 0.9]", 2, 26, "begin and end with the scene's time"},
           {"time [0, 1]\ntrajectory bspline knots [0]", 2, 26, "at least two"},
           {"time [0, 1]\ntrajectory bspline\ndof x", 2, 19, "'spans' and a number"},
           {head + "trajectory bspline spans 4 for xx", 4, 32, "did you mean 'x'?"},
           {head + "constant a = x", 4, 14, "depends on the motion"},
           {head + "dof y = x", 4, 9, "depends on the motion"},
           {head + "constrain (x, x') = (1, 2, 3) at 0", 4, 19, "2 components and the right side 3"},
           {head + "constrain x", 4, 12, "expected a relation"},
           {head + "constrain x = 1 = 2", 4, 17, "lo <= x <= hi"},
           {head + "constrain x < 3", 4, 13, "write '<='"},
           {head + "constrain x = 0 at 3", 4, 20, "which lies outside the scene's time [0, 2]"},
           {head + "constant T = 5\nconstrain x = 0 at 0, T/2", 5, 23, "is 2.5, which lies outside"},
           {head + "constrain x = 0 at x", 4, 20, "depends on the motion"},
           {head + "constrain x = 0 over [1, 0]", 4, 22, "later than its first"},
           {head + "constrain x = 0 over [0, 1] every 0", 4, 35, "greater than 0"},
           {head + "constrain x = 0 over [0, 1] every 1e-9", 4, 35, "more than 1000000 instances"},
           {head + "constrain x = 0 over [0, 1] count 1", 4, 35, "from 2"},
           {head + "constrain x = 0 at 0 weight -1", 4, 29, "cannot be negative"},
           {head + "constrain x = 0 at 0 at 1", 4, 22, "'at' stands twice"},
           {head + "minimize x", 4, 10, "put it inside integral( ) or at( , time)"},
           {head + "minimize integral((x, x'))", 4, 10, "must be a single number"},
           {head + "minimize x = 3", 4, 12, "write 'constrain'"},
           {head + "minimize integral(x) at 3", 4, 22, "an objective has no 'at'"},
           {head + "minimize integral(x) weight inf", 4, 22, "write a number"},
           {head + "keyframe 5: x = 1", 4, 10, "outside the scene's time"},
           {head + "keyframe 0: x' = 1", 4, 13, "only a degree of freedom can be keyed"},
           {head + "keyframe 0: x = t", 4, 17, "numbers and constants"},
           {head + "keyframe 0: x = 1, x = 2", 4, 20, "two keys at this time"},
           {head + "keyframe 0: x = 1\nkeyframe 1 - 1: x = 2", 5, 17, "two keys at this time"},
           {head + "keyframe 0 x = 1", 4, 12, "expected ':'"},
           {head + "iterate 2.5", 4, 9, "a whole number"},
           {head + "solve iterations -1", 4, 18, "a whole number"},
           {head + "solve tolerance 0", 4, 17, "greater than 0"},
           {head + "solve method newtn", 4, 14, "did you mean 'newton'?"},
           {head + "constrain 0 <= x >= 1", 4, 18, "lo <= x <= hi"},
           {head + "constrain (0, 1) <= x <= (1, 2, 3)", 4, 18, "2 components and the right side 3"},
           {head + "constrain x <= y", 4, 16, "unknown name 'y'"},
           {head + "constrain x <= 0 when x", 4, 23, "'when' takes a condition"},
           {head + "constrain x <= 0 when integral(x) > 1", 4, 23, "cannot be made of integral( )"},
           {head + "constrain x <= 0 when at(x, 1) > 1 and t < 1", 4, 23, "cannot be made of integral( )"},
           {head + "constrain x <= 0 when t < 1 when t > 0", 4, 29, "'when' stands twice"},
           {head + "dof y in [1, 0]", 4, 10, "upper bound must be greater"},
           {head + "dof y in [0, t]", 4, 14, "depends on time"},
           {head + "dof y = 3 in [0, 1]", 4, 14, "start value 3 lies outside"},
           {head + "dof y in 0", 4, 10, "an interval such as [0, 1]"},
           {time + "creature c { link l { revolute k in [1, 1]; a 1 } }", 3, 37, "upper bound must be greater"}})
    expect_one(wrong);
}

TEST(Diagnostics, Parameters) {
  const std::string p = head + "parameter m = 1\n";  // four lines
  for (const Wrong& wrong :
       std::vector<Wrong>{{head + "parameter m", 4, 12, "'=' and a start value"},
                          {head + "parameter x = 1", 4, 11, "'x' is declared twice"},
                          {head + "parameter m = x", 4, 15, "depends on the motion"},
                          {head + "parameter m = 1 in [2, 3]", 4, 20, "start value 1 lies outside"},
                          {head + "parameter m = 1 in [2, -3]", 4, 20, "upper bound must be greater"},
                          {p + "constrain x = 0 at m", 5, 20, "a parameter, which is not known before the motion is"},
                          {p + "constrain x = 0 over [0, m]", 5, 26, "a parameter"},
                          {p + "constrain x = 0 over [0, 2] every m", 5, 35, "a parameter"},
                          {p + "constrain x = 0 at 1 weight m", 5, 29, "a parameter"},
                          {p + "constant c = 2*m", 5, 14, "a parameter"},
                          {p + "minimize at(x, m)", 5, 16, "not of a parameter"},
                          {p + "minimize integral(x, 0, m)", 5, 25, "not of a parameter"},
                          {p + "dof y in [0, m]", 5, 14, "a parameter"},
                          {p + "dof y = m", 5, 9, "a parameter"},
                          {p + "parameter n = m", 5, 15, "a parameter"},
                          {p + "keyframe m: x = 1", 5, 10, "a parameter"},
                          {p + "keyframe 1: x = m", 5, 17, "numbers and constants"},
                          {p + "keyframe 1: m = 1", 5, 13, "only a degree of freedom can be keyed"},
                          {p + "set m = 3", 5, 5, "'m' is no constant"},
                          {p + "trajectory bspline spans m", 5, 26, "a parameter"},
                          {p + "script s { path [(0, 0, 0), (1, 0, m), (2, 0, 0), (3, 0, 0)] }", 5, 29, "a parameter"}})
    expect_one(wrong);
}

TEST(Diagnostics, Elimination) {
  const std::string arm =
      time + "creature arm { link a { revolute p; a 1; mass 1 }; link b { revolute r; a 1; mass 1 } }\n";
  for (const Wrong& wrong : std::vector<Wrong>{
           {head + "eliminate y = 2", 4, 11, "no degree of freedom 'y'"},
           {head + "eliminate x = y", 4, 15, "unknown name 'y'"},
           {head + "eliminate x = x'", 4, 15, "by means of itself"},
           {head + "eliminate x = (1, 2)", 4, 15, "must be a single number"},
           {head + "let h = x^2\neliminate x = t", 5, 11, "'x' is used on line 4, before it is eliminated"},
           {head + "constrain x = 0 at 1\neliminate x = t", 5, 11, "used on line 4"},
           {head + "keyframe 0: x = 1\neliminate x = t", 5, 11, "used on line 4"},
           {head + "eliminate x = t\neliminate x = 2*t", 5, 11, "'x' is eliminated on line 4"},
           {head + "eliminate x = t\nkeyframe 0: x = 1", 5, 13, "'x' is eliminated on line 4"},
           {head + "dof y\neliminate x = y\nkeyframe 0: x = 1", 6, 13, "'x' is eliminated on line 5"},
           {head + "eliminate x = t\nkey 0: x = 1", 5, 8, "'x' is eliminated on line 4"},
           {head + "eliminate x = t\nbound x in [0, 1]", 5, 7, "'x' is eliminated on line 4"},
           {head + "eliminate x = t\ncontrol x 1 = 0", 5, 9, "'x' is eliminated on line 4"},
           {head + "eliminate x = t\nwindow [0, 1] of x", 5, 18, "'x' is eliminated on line 4"},
           {head + "dof y in [0, 1]\neliminate y = x", 5, 11, "'y' has bounds"},
           {head + "constant g = 2\neliminate g = x", 5, 11, "no degree of freedom 'g'"},
           {head + "dof y\neliminate x = y''\nconstrain x' = 0 at 1", 6, 12, "third time derivative"},
           {arm + "eliminate arm = 2", 4, 11, "'arm' is a creature"},
           {arm + "eliminate arm.s = 2", 4, 11, "no degree of freedom 'arm.s'"},
           {arm + "eliminate arm.r = arm.p'", 4, 19, "two time derivatives"},
           {arm + "let h = arm.a.y + arm.b.y\neliminate arm.r = -arm.p", 5, 11, "used on line 4"},
           {arm + "minimize integral(dot(arm.force, arm.force))\neliminate arm.p = t", 5, 11, "used on line 4"},
           {arm + "eliminate arm.r = -arm.p\nkeyframe 0: arm.q = 1", 5, 13, "only a degree of freedom can be keyed"}})
    expect_one(wrong);
}

TEST(Diagnostics, Creatures) {
  const auto arm = [](const std::string& items, const std::string& after = "") {
    return time + "creature arm {\n" + items + "\n}\n" + after;  // items begin on line 4
  };
  const std::string link = "link one { revolute q1; a 1; mass 1; rod }\n";
  for (const Wrong& wrong : std::vector<Wrong>{
           {arm(""), 3, 1, "has no links"},
           {arm("link one { a 1 }"), 4, 6, "needs a joint"},
           {arm("link one { revolut q1; a 1 }", "let y = arm.q1\nlet z = arm.one"), 4, 12, "expected a joint"},
           {arm("link one { revolute q1; fixed }"), 4, 25, "a link has one joint"},
           {arm("link one { revolute q1; a 1; a 2 }"), 4, 30, "stands twice"},
           {arm("link one { revolute q1; a 1; axis (0, 0, 1) }"), 4, 30, "not by both"},
           {arm("link one { revolute q1; axis (0, 0, 0) }"), 4, 25, "must not be (0, 0, 0)"},
           {arm("link one { revolute q1; axis (0, 1) }"), 4, 30, "has 3 components, but here are 2"},
           {arm("link one { revolute q1; origin (0, 1, 0) }"), 4, 25, "needs an 'axis' too"},
           {arm("link one { fixed; axis (0, 1, 0) }"), 4, 19, "a fixed joint has no axis"},
           {arm("link one { fixed; offset 1 }"), 4, 19, "a fixed joint has no offset"},
           {arm("link one { revolute q1; a t }"), 4, 27, "depends on time"},
           {arm("link one { revolute q1; a 1; rod }"), 4, 30, "a rod needs a 'mass'"},
           {arm("link one { revolute q1; mass 1; rod }"), 4, 33, "a rod needs a length"},
           {arm("link one { revolute q1; a 1; mass 1; rod; com (0, 0, 0) }"), 4, 43, "its own centre of mass"},
           {arm("link one { revolute q1; a 1; com (0, 0, 0) }"), 4, 30, "needs a 'mass'"},
           {arm("link one { revolute q1; mass -1 }"), 4, 25, "cannot be negative"},
           {arm("link one { revolute q1; inertia (1, 2) }"), 4, 33, "3 components"},
           {arm("link one { revolute q1; inertia (1, -2, 1) }"), 4, 33, "cannot be negative"},
           {arm("link one { revolute q1; sphere 0.1; capsule 0.2 }"), 4, 37, "one shape"},
           {arm("link one { revolute force; a 1 }"), 4, 21, "taken inside creatures"},
           {arm("link one { revolute one; a 1 }"), 4, 21, "declared twice in 'arm'"},
           {arm(link + "link two on onr { revolute q2; a 1 }"), 5, 13, "did you mean 'one'?"},
           {arm(link + "point hand on two (0, 0, 0)"), 5, 15, "has no link 'two'"},
           {arm(link + "point hand on ground (0, 0, 0)"), 5, 15, "not on the ground"},
           {arm(link + "point hand on one (0, 0)"), 5, 19, "has 3 components"},
           {arm(link + "force on hand = (0, 0, 0)"), 5, 10, "has no point 'hand'"},
           {arm(link + "point hand on one (0, 0, 0)\nforce on hand = (arm.force, 0, 0)"), 6, 22,
            "cannot be made from them"},
           {arm(link + "gravity (0, -1, 0)\ngravity (0, -1, 0)"), 6, 1, "one 'gravity'"},
           {arm(link + "lnk two { fixed }"), 5, 1, "expected 'link', 'point', 'gravity' or 'force'"},
           {arm(link, "let y = arm.q2\nlet z = arm.q2' + arm.q2.force\nkeyframe 0: arm.q2 = 1"), 7, 13,
            "did you mean 'q1'?"},
           {arm(link, "let y = arm.q2"), 7, 13, "did you mean 'q1'?"},
           {arm(link, "let y = arm"), 7, 9, "name one of its members, such as arm.q"},
           {arm(link, "let y = arm.q1.torque"), 7, 16, "only 'force'"},
           {arm("link one { revolute q1; a 1 }", "let y = arm.com"), 6, 13, "no centre of mass"},
           {arm("link one { fixed; a 1 }", "let y = arm.q"), 6, 13, "no degrees of freedom"},
           {time + "creature arm {\nlink one { revolute q1; a 1\nlink two { revolute q2; a 1 }\n}\nlet y = arm.q2", 5,
            1, "expected '}' to close 'link one {'"},
           {time + "creature arm {\nlink one { revolute q1; a 1 }\nlet y = arm.q1\nsolve", 5, 1,
            "expected '}' to close 'creature arm {'"},
           {arm(link + "}\nlink two { fixed; a 1 }\npoint hand on two (0, 0, 0)", "let y = arm.hand.x"), 6, 1,
            "is a '}' too early?"},
           {arm("link one { revolute q1 } a 1; mass 1; rod }\nlink two { revolute q2; a 1 }"), 4, 26,
            "'a' can stand only inside 'link { }'"},
           {arm("link one { a 1 }\nrevolute q1\nmass 1 }\npoint hand on one (0, 0, 0)", "let y = arm.q1"), 5, 1,
            "'revolute' can stand only inside 'link { }': is a '}' too early?"},
           {arm(link + "mass 1"), 5, 1, "'mass' can stand only inside 'link { }'"},
           {arm("link one { revolute q1; a 1; mass 1..; rod }"), 4, 35, "is not a number"},
           {arm(link + "link two point { fixed; a 1 }"), 5, 10, "expected '{', found 'point'"}})
    expect_one(wrong);
}

TEST(Diagnostics, Scripts) {
  const std::string path = "path [(0, 0, 0), (1, 0, 0), (2, 1, 0), (3, 1, 1)]";
  for (const Wrong& wrong : std::vector<Wrong>{
           {head + "script s { path [(0, 0, 0), (1, 0, 0), (2, 0, 0)] }", 4, 17, "at least 4"},
           {head + "script s { path through [(0, 0, 0)] }", 4, 25, "at least 2"},
           {head + "script s { path [(0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)] }", 4, 18, "has 3 components"},
           {head + "script s { path [(0, 0, x), (1, 0, 0), (2, 0, 0), (3, 0, 0)] }", 4, 18, "depends on the motion"},
           {head + "script s { path [(0, 0, z), (1, 0, 0), (2, 0, 0), (3, 0, 0)] }", 4, 25, "unknown name 'z'"},
           {head + "script s { " + path + " knots [0, 1, 2] }", 4, 68, "need 2 knots"},
           {head + "script s { " + path + " knots [1, 0] }", 4, 72, "knots must rise"},
           {head + "script s { " + path + "; " + path + " }", 4, 8, "one 'path', but here are 2"},
           {head + "script s { travel constant }", 4, 8, "one 'path', but here are 0"},
           {head + "script s { " + path + "; travel [(0, 0), (0, 1)] }", 4, 79, "times must rise"},
           {head + "script s { " + path + "; travel [(0, 0)] }", 4, 70, "at least 2"},
           {head + "script s { " + path + "; travel [(0, 0), (1, 1)] knots [0, 1] }", 4, 93, "'travel control'"},
           {head + "script s { " + path + "; travel control [(0, 0), (1, 1)] }", 4, 78, "at least 4"},
           {head + "script s { " + path + "; travel constant; travel constant }", 4, 8, "one 'travel'"},
           {head + "script s { " + path + "; orient [(0, (1, 0, 0))] }", 4, 71, "has 5 components"},
           {head + "script s { " + path + "; orient along up (0, 1) }", 4, 79, "has 3 components"},
           {head + "script s { " + path + "; jump }", 4, 63, "'path', 'travel' or 'orient'"},
           {head + "script s { " + path + "; travel constant }\nlet y = s.x", 4, 1, "not built yet"},
           {"time [0, 1]\ntrajectory wavelet level 2.5\ndof x", 2, 26, "a whole number"},
           {"time [0, 1]\ntrajectory wavelet 5\ndof x", 2, 20, "expected 'level'"}})
    expect_one(wrong);
}

}  // namespace
}  // namespace spacetime::symbolic
