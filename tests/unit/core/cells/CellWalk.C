// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/CellWalk.H"

#include "shapes/BoxMesh.H"
#include "shapes/CutOut.H"
#include "shapes/PolyMeshes.H"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>
#include <random>

using namespace Foam;
using namespace Foam::stability;

namespace
{

using Where = Location::Where;

// Warped faces everywhere but on the boundary, and edges from 0.5 to 1.5.
point warp(const point& x, scalar size)
{
    const vector s = x / size;
    const scalar inside =
        64 * s.x() * (1 - s.x()) * s.y() * (1 - s.y()) * s.z() * (1 - s.z());
    return x
           + 0.045 * size * inside
                 * vector(
                     std::sin(19 * s.y() + 7 * s.z()), std::sin(23 * s.z() - 5 * s.x()),
                     std::cos(17 * s.x() + 3 * s.y())
                 );
}

std::shared_ptr<const CellComplex> warpedCube(label n, scalar size = 1)
{
    shapes::BoxOptions options;
    options.n = Vector<label>(n, n, n);
    options.max = point(size, size, size);
    options.map = [size](const point& x) { return warp(x, size); };
    return shapes::box(options);
}

class Sampler
{
public:
    scalar operator()() { return distribution_(engine_); }
    point inCube() { return point((*this)(), (*this)(), (*this)()); }

private:
    std::mt19937 engine_{7};
    std::uniform_real_distribution<scalar> distribution_{0, 1};
};

point weighted(const CellComplex& complex, const Location& location)
{
    point x = location.weights[0] * complex.cellCentres()[location.cell];
    for (direction i = 0; i < 3; ++i)
    {
        x += location.weights[i + 1] * complex.points()[location.points[i]];
    }
    return x;
}

// A wall of cells across the channel up to half its height, or with a lid at half
// its height.
std::shared_ptr<const CellComplex> step()
{
    shapes::BoxOptions options;
    options.n = Vector<label>(8, 2, 8);
    const auto obstacle = [](const point& x)
    { return x.x() > 0.375 && x.x() < 0.625 && x.z() < 0.5; };
    return std::make_shared<const CellComplex>(
        shapes::cutOut(shapes::boxInput(options), obstacle)
    );
}

std::shared_ptr<const CellComplex> channelWithBaffle()
{
    shapes::BoxOptions options;
    options.n = Vector<label>(8, 8, 8);
    const auto none = [](const point&) { return false; };
    const auto baffle = [](const point& x)
    { return std::abs(x.z() - 0.5) < 1e-6 && x.x() < 0.7; };
    return std::make_shared<const CellComplex>(
        shapes::cutOut(shapes::boxInput(options), none, baffle)
    );
}

} // namespace

class CellWalkOnMeshes : public testing::TestWithParam<const char*>
{
protected:
    static std::shared_ptr<const CellComplex> mesh()
    {
        const std::string name = GetParam();
        shapes::BoxOptions options;
        if (name == "warped")
        {
            return warpedCube(10);
        }
        if (name == "tetrahedra")
        {
            return shapes::complexOf(shapes::tetrahedralBox(options));
        }
        if (name == "refined")
        {
            const auto refine = [](const point& x)
            { return mag(x - point(0.3, 0.4, 0.5)) < 0.3; };
            return shapes::complexOf(shapes::refinedBox(options, refine));
        }
        return shapes::complexOf(shapes::perturbedBox(options, 0.25));
    }
};

INSTANTIATE_TEST_SUITE_P(
    , CellWalkOnMeshes, testing::Values("warped", "perturbed", "tetrahedra", "refined"),
    [](const auto& info) { return std::string(info.param); }
);

TEST_P(CellWalkOnMeshes, FindsEveryPointFromAnyHint)
{
    const auto complex = mesh();
    Sampler random;
    CellHint follow;
    for (label n = 0; n < 2000; ++n)
    {
        const point x = random.inCube();
        CellHint any{label(random() * complex->nCells()), label(30 * random()) - 3};
        CellHint wrong{n % 2 ? -5 : 2000000000, 1 << 30};
        const Location near = locate(*complex, x, follow);
        for (const Location& location :
             {near, locate(*complex, x, any), locate(*complex, x, wrong)})
        {
            ASSERT_EQ(location.where, Where::inside);
            ASSERT_EQ(location.boundaryFace, -1);
            ASSERT_EQ(location.position, x);
            ASSERT_LT(mag(weighted(*complex, location) - x), 1e-12);
            ASSERT_EQ(location.cell, near.cell);
            const auto& w = location.weights;
            ASSERT_GE(min(min(w[0], w[1]), min(w[2], w[3])), 0);
            ASSERT_NEAR(w[0] + w[1] + w[2] + w[3], 1, 1e-14);
        }
        ASSERT_EQ(any.cell, near.cell);
        ASSERT_EQ(any.tet, follow.tet);
    }
}

// Where tetrahedra meet round-off decides, and must not leave a gap.
TEST_P(CellWalkOnMeshes, LeavesNoGapBetweenTetrahedra)
{
    const auto complex = mesh();
    CellHint hint;
    label nChecked = 0;
    const auto check = [&](const point& x)
    {
        const Location location = locate(*complex, x, hint);
        ASSERT_EQ(location.where, Where::inside);
        // Points of the boundary may lie outside by round-off.
        ASSERT_LT(mag(location.position - x), 1e-6);
        ASSERT_LT(mag(weighted(*complex, location) - location.position), 1e-9);
        const auto& w = location.weights;
        ASSERT_GE(min(min(w[0], w[1]), min(w[2], w[3])), 0);
        ++nChecked;
    };
    for (label celli = 0; celli < complex->nCells(); ++celli)
    {
        const point& centre = complex->cellCentres()[celli];
        check(centre);
        for (const label facei : complex->cellFaces()[celli])
        {
            const face& f = complex->faces()[facei];
            forAll(f, i)
            {
                const point& a = complex->points()[f[i]];
                const point& b = complex->points()[f[f.fcIndex(i)]];
                for (const scalar s : {0.1, 1.0 / 3, 0.7, 1.0})
                {
                    check(centre + s * (a - centre));
                    check(centre + s * (0.3 * a + 0.7 * b - centre));
                }
            }
        }
    }
    EXPECT_GT(nChecked, 20000);
}

// Cells so crooked that their centre sees faces from behind: nothing is exact then,
// but the walk ends, with weights that extrapolate nothing, near x.
TEST(CellWalk, CrookedCellsDoNoHarm)
{
    const auto complex =
        shapes::complexOf(shapes::perturbedBox(shapes::BoxOptions(), 0.6));
    Sampler random;
    CellHint hint;
    for (label n = 0; n < 20000; ++n)
    {
        const point x = random.inCube();
        const Location location = locate(*complex, x, hint);
        ASSERT_EQ(location.where, Where::inside);
        const auto& w = location.weights;
        ASSERT_GE(min(min(w[0], w[1]), min(w[2], w[3])), 0);
        ASSERT_LT(mag(weighted(*complex, location) - x), 0.5 / 8);
    }
}

TEST(CellWalk, ScaleDoesNotMatter)
{
    for (const scalar scale : {1e-5, 1e3})
    {
        const auto one = warpedCube(8);
        const auto scaled = warpedCube(8, scale);
        Sampler random;
        CellHint hint, scaledHint;
        for (label n = 0; n < 500; ++n)
        {
            // Some of them outside.
            const point x = 1.1 * random.inCube();
            const Location location = locate(*one, x, hint);
            const Location other = locate(*scaled, scale * x, scaledHint);
            ASSERT_EQ(location.where, other.where);
            ASSERT_EQ(location.cell, other.cell);
            ASSERT_LT(mag(location.position - other.position / scale), 1e-12);
            for (direction i = 0; i < 4; ++i)
            {
                ASSERT_NEAR(location.weights[i], other.weights[i], 1e-9);
            }
        }
    }
}

TEST(CellWalk, PutsBackOntoWalls)
{
    const auto complex = shapes::unitCube(8);
    const scalar inset = 1e-6 / 8;

    CellHint hint{0, 0};
    const Location floor = locate(*complex, point(0.26, 0.13, -0.07), hint);
    EXPECT_EQ(floor.where, Where::inside);
    EXPECT_LT(mag(floor.position - point(0.26, 0.13, inset)), 1e-12);
    const label facei = complex->nInternalFaces() + floor.boundaryFace;
    EXPECT_LT(complex->faceCentres()[facei].z(), 1e-12);
    EXPECT_EQ(floor.cell, complex->findCell(floor.position));

    const Location edge = locate(*complex, point(0.26, -0.03, -0.07), hint);
    EXPECT_LT(mag(edge.position - point(0.26, inset, inset)), 1e-12);
    const Location corner = locate(*complex, point(1.02, -0.03, -0.07), hint);
    EXPECT_LT(mag(corner.position - point(1 - inset, inset, inset)), 1e-12);
    EXPECT_EQ(corner.where, Where::inside);
}

TEST(CellWalk, OpenBoundaryIsOutside)
{
    shapes::BoxOptions options;
    options.kinds[5] = BoundaryKind::open;
    const auto complex = shapes::box(options);
    CellHint hint{0, 0};
    const Location top = locate(*complex, point(0.26, 0.13, 1.07), hint);
    EXPECT_EQ(top.where, Where::outside);
    EXPECT_LT(mag(top.position - point(0.26, 0.13, 1)), 1e-12);
    EXPECT_EQ(complex->patchNames()[complex->patches()[top.boundaryFace]], "zMax");
    // Also beyond the wall at its side.
    const Location rim = locate(*complex, point(0.26, -0.02, 1.07), hint);
    EXPECT_EQ(rim.where, Where::outside);
    EXPECT_LT(mag(rim.position - point(0.26, 0, 1)), 1e-6);
    // The boundary itself belongs to the mesh.
    EXPECT_EQ(locate(*complex, point(0.26, 0.13, 1), hint).where, Where::inside);
}

TEST(CellWalk, FarAwayIsNowhere)
{
    const auto complex = shapes::unitCube(8);
    const scalar nan = std::numeric_limits<scalar>::quiet_NaN();
    const scalar infinity = std::numeric_limits<scalar>::infinity();
    for (const point& x :
         {point(0.5, 0.5, 40), point(-1e30, 0, 0), point(0.5, nan, 0.5),
          point(infinity, 0.5, 0.5)})
    {
        CellHint hint{3, 0};
        EXPECT_EQ(locate(*complex, x, hint).where, Where::nowhere);
    }
}

TEST(CellWalk, GoesAroundAnEdgeButNotThroughAWall)
{
    const auto complex = step();
    // From beside the step to above it: the straight way cuts its edge.
    const point below(0.37, 0.2, 0.42);
    const point above(0.45, 0.2, 0.515);
    CellHint hint;
    ASSERT_EQ(locate(*complex, below, hint).where, Where::inside);
    const Location around = locate(*complex, above, hint);
    EXPECT_EQ(around.where, Where::inside);
    EXPECT_EQ(around.position, above);

    // Into the step: back to the side where it came from.
    CellHint side;
    locate(*complex, below, side);
    const Location stopped = locate(*complex, point(0.45, 0.2, 0.3), side);
    EXPECT_NEAR(stopped.position.x(), 0.375, 1e-6);
    EXPECT_NEAR(stopped.position.z(), 0.3, 1e-12);

    // The far side of the step lies within reach of the hint but behind a wall.
    CellHint left;
    locate(*complex, point(0.37, 0.2, 0.05), left);
    const Location blocked = locate(*complex, point(0.66, 0.2, 0.05), left);
    EXPECT_NEAR(blocked.position.x(), 0.375, 1e-6);
    // A hint from far away proves nothing.
    CellHint far{0, 0};
    const Location fresh = locate(*complex, point(0.95, 0.2, 0.05), far);
    EXPECT_EQ(fresh.where, Where::inside);
}

TEST(CellWalk, ThinWallHolds)
{
    const auto complex = channelWithBaffle();
    CellHint below;
    locate(*complex, point(0.3, 0.3, 0.45), below);
    const Location stopped = locate(*complex, point(0.3, 0.3, 0.55), below);
    EXPECT_NEAR(stopped.position.z(), 0.5, 1e-6);
    EXPECT_LT(stopped.position.z(), 0.5);
    CellHint above;
    locate(*complex, point(0.3, 0.3, 0.56), above);
    EXPECT_GT(locate(*complex, point(0.3, 0.3, 0.45), above).position.z(), 0.5);
    // Beside the thin wall the way is free.
    CellHint beside;
    locate(*complex, point(0.9, 0.3, 0.45), beside);
    EXPECT_EQ(
        locate(*complex, point(0.9, 0.3, 0.55), beside).position, point(0.9, 0.3, 0.55)
    );
}
