// SPDX-License-Identifier: GPL-3.0-or-later
#include "harness/cli/program.hpp"

int main(int argc, char** argv) { return sphverify::program_main(argc, argv, {}); }
