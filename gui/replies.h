// Daemons' answers as events.  Documents become values here, in the thread that receives them, and are checked: a
// daemon may be anybody's.  All throw InputError for what is not as the protocol says.
#pragma once

#include <map>
#include <string>

#include "gui/event.h"
#include "protocol/json.h"

namespace spacetime::gui {

Compiled compiled_from(int number, const std::string& text, const Json& result);
Iterated iterated_from(int number, const Json& value);
Done done_from(int number, const Json& result);
Reached reached_from(int number, const Json& result, bool checkpoint);
Sampled sampled_from(int number, const Json& result);
Answered answered_from(int number, const Json& result);

// Puts a later progress of the same run into one that nobody has taken yet.
void merge(Iterated& earlier, Iterated later);

}  // namespace spacetime::gui
