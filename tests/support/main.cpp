// main() of all test programs that do not define their own.
#include "tests/support/test_program.hpp"

int main(int argc, char** argv) { return skein::run_test_program(argc, argv); }
