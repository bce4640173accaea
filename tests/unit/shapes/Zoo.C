// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/Zoo.H"

#include "shapes/PolyMeshes.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace Foam;
using namespace Foam::stability;

namespace
{

// The largest angle [degrees] between the normal of an internal face and the line of
// its cells' centres.
scalar nonOrthogonality(const CellComplex& complex)
{
    scalar least = 1;
    for (label facei = 0; facei < complex.nInternalFaces(); ++facei)
    {
        const vector d = complex.cellCentres()[complex.neighbour()[facei]]
                         - complex.cellCentres()[complex.owner()[facei]];
        const vector& S = complex.faceAreas()[facei];
        least = std::min(least, (d & S) / (mag(d) * mag(S)));
    }
    return std::acos(least) * 180 / M_PI;
}

// Volume [m3] of each cell by the parts between its centre and the triangles of its
// faces: exactAlpha cuts the cells into these.
bool isStarShaped(const CellComplex& complex, label celli)
{
    for (const label facei : complex.cellFaces()[celli])
    {
        const scalar sign = complex.owner()[facei] == celli ? 1 : -1;
        const face& f = complex.faces()[facei];
        forAll(f, k)
        {
            const point& middle = complex.faceCentres()[facei];
            const vector S = (complex.points()[f[k]] - middle)
                             ^ (complex.points()[f.nextLabel(k)] - middle);
            if (sign * (S & (middle - complex.cellCentres()[celli])) <= 0)
            {
                return false;
            }
        }
    }
    return true;
}

// True where a point of the cell lies beyond the plane of one of its faces.
bool isConcave(const CellComplex& complex, label celli)
{
    for (const label facei : complex.cellFaces()[celli])
    {
        const scalar sign = complex.owner()[facei] == celli ? 1 : -1;
        const vector S = sign * complex.faceAreas()[facei];
        for (const label other : complex.cellFaces()[celli])
        {
            for (const label pointi : complex.faces()[other])
            {
                const vector off =
                    complex.points()[pointi] - complex.faceCentres()[facei];
                if (!complex.faces()[facei].found(pointi)
                    && (off & S) > 1e-6 * mag(S) * complex.cellSizes()[celli])
                {
                    return true;
                }
            }
        }
    }
    return false;
}

class EachOfTheZoo : public ::testing::TestWithParam<shapes::ZooMesh>
{
protected:
    const std::shared_ptr<const CellComplex> complex_ =
        shapes::complexOf(GetParam().make());
};

std::string zooName(const ::testing::TestParamInfo<shapes::ZooMesh>& info)
{
    return info.param.name;
}

} // namespace

// Closed cells of positive volume, which exactAlpha can cut; numbered by OpenFOAM's
// rules.
TEST_P(EachOfTheZoo, isSound)
{
    const CellComplex& complex = *complex_;
    EXPECT_LT(max(complex.owner()), complex.nCells());
    for (label facei = 0; facei < complex.nInternalFaces(); ++facei)
    {
        EXPECT_LT(complex.owner()[facei], complex.neighbour()[facei]);
    }
    label nBad = 0;
    for (label celli = 0; celli < complex.nCells(); ++celli)
    {
        vector sum(Zero);
        scalar largest = 0;
        for (const label facei : complex.cellFaces()[celli])
        {
            const scalar sign = complex.owner()[facei] == celli ? 1 : -1;
            sum += sign * complex.faceAreas()[facei];
            largest = std::max(largest, mag(complex.faceAreas()[facei]));
        }
        EXPECT_LT(mag(sum), 1e-9 * largest);
        nBad += !isStarShaped(complex, celli);
    }
    EXPECT_EQ(nBad, 0);
}

// The ball and the plane meet cells of about the size that the radius follows from.
TEST_P(EachOfTheZoo, hasABallOfItsSize)
{
    const shapes::ZooMesh& mesh = GetParam();
    const shapes::Shape ball = mesh.ball();
    scalar largest = 0;
    for (label celli = 0; celli < complex_->nCells(); ++celli)
    {
        const scalar h = complex_->cellSizes()[celli];
        if (mag(ball(complex_->cellCentres()[celli])) < 0.5 * h)
        {
            largest = std::max(largest, h);
        }
    }
    if (mesh.kind != shapes::ZooKind::tiny)
    {
        EXPECT_NEAR(mesh.radius / largest / 4.8, 1, 0.3);
        const scalarField alpha(shapes::exactAlpha(*complex_, mesh.plane(), 1));
        EXPECT_GT(max(alpha), 0.5);
        EXPECT_LT(min(alpha), 0.5);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Zoo, EachOfTheZoo, ::testing::ValuesIn(shapes::zoo()), zooName
);

TEST(Zoo, hasTheKindsThatItsNamesTell)
{
    const auto complexOf = [](const char* name)
    { return shapes::complexOf(shapes::zooMesh(name).make()); };
    for (const char* name : {"renumbered", "refined", "tetrahedra", "polyhedra"})
    {
        const auto complex = complexOf(name);
        EXPECT_LT(max(complex->owner()), complex->nCells() - 1) << name;
    }
    std::set<long> sizes;
    const auto refined = complexOf("refined");
    for (const scalar h : refined->cellSizes())
    {
        sizes.insert(std::lround(100 * h));
    }
    EXPECT_EQ(sizes, (std::set<long>{25, 50, 100}));
    EXPECT_GT(nonOrthogonality(*complexOf("refinedOblique")), 78);
    EXPECT_LT(nonOrthogonality(*complexOf("refinedOblique")), 81);

    const auto concave = complexOf("concave");
    label nConcave = 0;
    for (label celli = 0; celli < concave->nCells(); ++celli)
    {
        nConcave += isConcave(*concave, celli);
    }
    EXPECT_GT(nConcave, 20);

    for (const label aspect : {10, 100, 1000})
    {
        const auto complex = complexOf(("layers" + std::to_string(aspect)).c_str());
        EXPECT_NEAR(min(complex->cellVolumes()) * aspect, 1, 1e-9);
        EXPECT_NEAR(max(complex->cellVolumes()), 1, 1e-9);
    }
    EXPECT_THROW(shapes::zooMesh("unicorn"), std::logic_error);
}
