// SPDX-License-Identifier: GPL-3.0-or-later

#include "error.H"

#include <gtest/gtest.h>

int main(int argc, char* argv[])
{
    // OpenFOAM's fatal errors become failures of one test instead of the program's end.
    Foam::FatalError.throwExceptions();
    Foam::FatalIOError.throwExceptions();
    ::testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
