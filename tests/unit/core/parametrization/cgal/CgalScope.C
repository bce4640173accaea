// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/parametrization/cgal/CgalScope.H"

#include <CGAL/assertions.h>

#include <gtest/gtest.h>

#include <new>

using namespace Foam;
using namespace Foam::stability;

// What CGAL's own checks do where they fail; the behaviour of the program around it
// stays.
TEST(CgalScope, failedChecksBecomeFailuresOfTheMethod)
{
    const auto before = CGAL::set_error_behaviour(CGAL::ABORT);
    const auto failing = []() -> int
    {
        CGAL::assertion_fail("x > 0", __FILE__, __LINE__);
        return 1;
    };
    try
    {
        withCgal(failing);
        ADD_FAILURE() << "nothing is thrown";
    }
    catch (const NumericalFailure& failure)
    {
        EXPECT_STREQ(failure.what(), "CGAL's check \"x > 0\" failed");
    }
    EXPECT_EQ(CGAL::set_error_behaviour(before), CGAL::ABORT);
}

TEST(CgalScope, lackOfMemoryStaysWhatItIs)
{
    EXPECT_EQ(withCgal([] { return 7; }), 7);
    EXPECT_THROW(withCgal([]() -> int { throw std::bad_alloc(); }), std::bad_alloc);
    EXPECT_THROW(
        withCgal([]() -> int { throw std::out_of_range("x"); }), NumericalFailure
    );
}
