// Standard input, output and error as the rest of the program expects them.
#pragma once

namespace rockyard::app {

// To be called first of all. A stream that the caller has closed is opened, so that no file of a
// run gets its number and what is printed: reading finds its end, writing fails (console.h).
// Writing into a pipe without a reader, or beyond a limit on the size of files, becomes an error
// instead of a signal that would end the program before what it was asked for is stored.
void PrepareStandardStreams();

}  // namespace rockyard::app
