// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/volumeFit/CellSolid.H"
#include "shapes/PlaneVolume.H"
#include "shapes/PolyMeshes.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

const Vector<label> n(3, 4, 5);
const vector edges(0.3, 0.2, 0.25); // [m], of the cells

shapes::BoxOptions boxOptions()
{
    shapes::BoxOptions options;
    options.min = point(-0.2, 0.1, 5);
    options.n = n;
    options.max =
        options.min + vector(n.x() * edges.x(), n.y() * edges.y(), n.z() * edges.z());
    return options;
}

// A triangle of the plane through x that is wider than the box by far.
Corners wideTriangle(const point& x, const vector& normal)
{
    constexpr scalar width = 200;
    const vector a = (normal ^ vector(0.3, -0.7, 0.2)) / mag(normal);
    const vector b = (normal ^ a) / mag(normal);
    return {x + width * a, x + width * (b - a), x - width * (a + b)};
}

} // namespace

TEST(CellSolid, volumesAreThoseOfTheMesh)
{
    for (const CellComplexInput& input :
         {shapes::perturbedBox(boxOptions()), shapes::tetrahedralBox(boxOptions()),
          shapes::refinedBox(boxOptions(), [](const point& x) { return x.x() > 0.1; })})
    {
        const auto complex = shapes::complexOf(input);
        for (label celli = 0; celli < complex->nCells(); ++celli)
        {
            const scalar V = complex->cellVolumes()[celli];
            EXPECT_NEAR(CellSolid(*complex, celli).volume() / V, 1, 1e-12);
        }
    }
}

TEST(CellSolid, aPlaneCutsWhatTheClosedFormSays)
{
    const auto complex = shapes::box(boxOptions());
    const vector normals[] = {{0.3, 0.4, 0.9}, {-2, 1, 0.8}, {0.1, 1, -0.3}};
    for (const vector& normal : normals)
    {
        const point x = complex->bounds().midpoint() + vector(0.013, 0.021, -0.017);
        const Corners triangle = wideTriangle(x, normal);
        const scalar up =
            ((triangle[1] - triangle[0]) ^ (triangle[2] - triangle[0])).z() > 0 ? 1
                                                                                : -1;
        const vector rises =
            (normal.z() > 0 ? 1 : -1) * cmptMultiply(normal, edges) / mag(normal);
        label nCut = 0;
        for (label celli = 0; celli < complex->nCells(); ++celli)
        {
            const CellSolid cell(*complex, celli);
            const scalar level = (normal.z() > 0 ? 1 : -1) / mag(normal)
                                 * ((complex->cellCentres()[celli] - x) & normal);
            const auto share = [&](scalar d)
            { return shapes::boxShareBehind(level + d, rises); };
            EXPECT_NEAR(
                cell.volumeBelow(triangle), up * share(0) * cell.volume(), 1e-12
            );
            constexpr scalar d = 1e-6; // [m]; the area is how fast the volume changes
            EXPECT_NEAR(
                cell.areaWithin(triangle),
                (share(-d) - share(d)) / (2 * d) * cell.volume(), 1e-7
            );
            nCut += share(0) > 0 && share(0) < 1;
        }
        EXPECT_GT(nCut, 10);
    }
}

// Each bit of a triangle lies in one cell.
TEST(CellSolid, theAreasInAllCellsAreTheTriangle)
{
    for (const CellComplexInput& input :
         {shapes::perturbedBox(boxOptions()), shapes::tetrahedralBox(boxOptions())})
    {
        const auto complex = shapes::complexOf(input);
        const point x = complex->bounds().midpoint();
        const Corners triangle{
            x + vector(0.31, 0.12, -0.41), x + vector(-0.23, 0.33, 0.17),
            x + vector(0.07, -0.29, 0.36)};
        scalar area = 0;
        for (label celli = 0; celli < complex->nCells(); ++celli)
        {
            area += CellSolid(*complex, celli).areaWithin(triangle);
        }
        const vector S = (triangle[1] - triangle[0]) ^ (triangle[2] - triangle[0]);
        EXPECT_NEAR(area / (0.5 * mag(S)), 1, 1e-12);
    }
}

TEST(CellSolid, anUprightTriangleHasNothingBelow)
{
    const auto complex = shapes::box(boxOptions());
    const Corners triangle =
        wideTriangle(complex->bounds().midpoint(), vector(1, 2, 0));
    for (label celli = 0; celli < complex->nCells(); ++celli)
    {
        EXPECT_NEAR(CellSolid(*complex, celli).volumeBelow(triangle), 0, 1e-12);
    }
}
