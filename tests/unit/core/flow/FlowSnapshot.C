// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/flow/FlowSnapshot.H"
#include "core/base/Errors.H"
#include "shapes/BoxMesh.H"

#include <gtest/gtest.h>

#include <limits>

using namespace Foam;
using namespace Foam::stability;

namespace
{

FlowSnapshot sound()
{
    FlowSnapshot snapshot;
    snapshot.complex = shapes::unitCube(2);
    snapshot.alphas = {scalarField(8, 0.3)};
    snapshot.boundaryAlphas = {scalarField(24, 0.3)};
    snapshot.U = vectorField(8, vector(1, 2, 3));
    snapshot.boundaryU = vectorField(24, Zero);
    return snapshot;
}

std::string messageOf(const FlowSnapshot& snapshot)
{
    try
    {
        snapshot.check();
    }
    catch (const BadInput& error)
    {
        return error.what();
    }
    return "";
}

constexpr scalar notANumber = std::numeric_limits<scalar>::quiet_NaN();
constexpr scalar infinite = std::numeric_limits<scalar>::infinity();

} // namespace

TEST(FlowSnapshot, acceptsRoundOffOfASolver)
{
    FlowSnapshot snapshot(sound());
    snapshot.alphas[0][3] = -1e-8;
    snapshot.boundaryAlphas[0][5] = 1 + 1e-3;
    EXPECT_NO_THROW(snapshot.check());
}

TEST(FlowSnapshot, namesWhatIsNotFinite)
{
    FlowSnapshot snapshot(sound());
    snapshot.alphas[0][3] = notANumber;
    EXPECT_NE(messageOf(snapshot).find("not finite at ("), std::string::npos);

    snapshot = sound();
    snapshot.U[7].y() = infinite;
    EXPECT_NE(messageOf(snapshot).find("velocity in the cells"), std::string::npos);

    snapshot = sound();
    snapshot.boundaryU[23].z() = notANumber;
    EXPECT_NE(messageOf(snapshot).find(" at ("), std::string::npos);
}

TEST(FlowSnapshot, namesFractionsFarOutside)
{
    FlowSnapshot snapshot(sound());
    snapshot.alphas[0][2] = 1.2;
    EXPECT_NE(messageOf(snapshot).find("1.2"), std::string::npos);
    snapshot = sound();
    snapshot.boundaryAlphas[0][2] = -0.2;
    EXPECT_NE(messageOf(snapshot).find("boundary"), std::string::npos);
}

TEST(FlowSnapshot, namesSizesThatDoNotFit)
{
    FlowSnapshot snapshot(sound());
    snapshot.U.setSize(7);
    EXPECT_NE(messageOf(snapshot).find("7 values"), std::string::npos);
    snapshot = sound();
    snapshot.alphas.clear();
    EXPECT_NE(messageOf(snapshot), "");
}
