#include "app/store_notes.h"

#include "app/console.h"
#include "campaign/store_notes.h"

namespace rockyard::app {

void NoteStores(std::span<const std::string> paths) {
  for (const std::string& note : campaign::StoreNotes(paths)) PrintNote(note);
}

}  // namespace rockyard::app
