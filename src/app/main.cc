#include "app/command_line.h"

int main(int argc, char** argv) { return rockyard::app::RunCommandLine(argc, argv); }
