// What all test programs do. A program holds the tests of a folder; CTest has an entry for each file of it, or for a
// few files that belong together:
//   core_tests --entry core_text_test --file core/text_test.cpp [--file ...]
// runs the tests of these files, and names its report after the entry. Without these options it is GoogleTest's own.
#pragma once

namespace skein {

/// Takes its own options and GoogleTest's, and runs the tests. @returns the exit code: 2 for a wrong command line.
int run_test_program(int argc, char** argv);

}  // namespace skein
