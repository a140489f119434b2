// The journal of a session: everything that its text does not hold and that must outlive a crash, one JSON object a
// line, in the order it happened.
//   {"journal":"spacetime-journal/1","file":F,"saved":T,"text":T,"script":[...]}   the scene as it was opened: entry 0
//   {"entry":i,"number":n,"adds":T,"text":T,"actions":[...],"iterated":b,"script":k}   entry i of the log, which ends
//                                   with it; it adds to the text before it and leaves k lines of the script
//   {"checkpoint":n,"motion":{...}}  where the entry of that number led
//   {"present":i}                    the entry that is shown
//   {"saved":T,"file":F}             what the file holds
//   {"pins":[t, ...]}                times, s, at which ghosts are pinned
// A line that is cut short, or that makes no sense, ends what is read.
#pragma once

#include <string>
#include <string_view>

#include "gui/event.h"
#include "gui/state.h"

namespace spacetime::gui {

std::string journal_begin(const State& state);
// `before` is the scene that the entry's text continues.
std::string journal_entry(const Entry& entry, const Scene& before, std::size_t index, std::size_t script);
std::string journal_checkpoint(const Entry& entry);
std::string journal_present(int index);
std::string journal_saved(const State& state);
std::string journal_pins(const State& state);

// The session as the journal leaves it.  Entries behind the last that a checkpoint is known of become lines of the
// script: they are to be performed again.  Throws InputError where not even the beginning can be read.
Restored read_journal(std::string_view text);
// Whether there is anything in it that its file does not hold.
bool unsaved(const Restored& restored);

}  // namespace spacetime::gui
