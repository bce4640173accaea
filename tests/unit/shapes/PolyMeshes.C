// SPDX-License-Identifier: GPL-3.0-or-later

#include "shapes/PolyMeshes.H"
#include "shapes/DualMesh.H"

#include <gtest/gtest.h>

#include <algorithm>

using namespace Foam;
using namespace Foam::stability;

namespace
{

shapes::BoxOptions wideBox()
{
    shapes::BoxOptions options;
    options.min = point(-0.2, 0.1, 0);
    options.max = point(0.7, 0.7, 1.2);
    options.n = Vector<label>(5, 3, 6);
    return options;
}

// Closed cells, positive volumes that fill the box, normals from owner to neighbour.
void expectSound(const CellComplex& complex)
{
    EXPECT_NEAR(sum(complex.cellVolumes()), 0.9 * 0.6 * 1.2, 1e-12);
    EXPECT_GT(min(complex.cellVolumes()), 0);
    for (label celli = 0; celli < complex.nCells(); ++celli)
    {
        vector sum(Zero);
        for (const label facei : complex.cellFaces()[celli])
        {
            const scalar sign = complex.owner()[facei] == celli ? 1 : -1;
            const vector S = sign * complex.faceAreas()[facei];
            const vector arm =
                complex.faceCentres()[facei] - complex.cellCentres()[celli];
            EXPECT_GT(arm & S, 0);
            sum += S;
        }
        EXPECT_LT(mag(sum), 1e-13);
    }
}

} // namespace

TEST(PolyMeshes, perturbedBoxIsSound)
{
    const CellComplex complex(shapes::perturbedBox(wideBox()));
    expectSound(complex);
    EXPECT_GT(max(complex.cellVolumes()) / min(complex.cellVolumes()), 1.2);
}

TEST(PolyMeshes, tetrahedralBoxIsSound)
{
    const CellComplex complex(shapes::tetrahedralBox(wideBox()));
    expectSound(complex);
    EXPECT_EQ(complex.nCells(), 6 * 90);
    EXPECT_EQ(complex.faces()[0].size(), 3);
}

TEST(PolyMeshes, refinedBoxIsSoundAndHasPolyhedra)
{
    const auto lower = [](const point& x) { return x.z() < 0.5 && x.x() > 0; };
    const CellComplex complex(shapes::refinedBox(wideBox(), lower));
    expectSound(complex);
    label mostFaces = 0;
    label mostCorners = 0;
    for (label celli = 0; celli < complex.nCells(); ++celli)
    {
        mostFaces = max(mostFaces, complex.cellFaces()[celli].size());
    }
    for (const face& f : complex.faces())
    {
        mostCorners = max(mostCorners, f.size());
    }
    EXPECT_GT(mostFaces, 6);
    EXPECT_GT(mostCorners, 4);
}

TEST(PolyMeshes, dualBoxIsSoundAndOfPolyhedra)
{
    const CellComplex complex(shapes::dualBox(wideBox()));
    expectSound(complex);
    EXPECT_EQ(complex.nCells(), 6 * 4 * 7); // the points of the tetrahedra
    label nInside = 0;
    scalar nFaces = 0;
    for (label celli = 0; celli < complex.nCells(); ++celli)
    {
        const UList<label> faces = complex.cellFaces()[celli];
        const bool inside = std::all_of(
            faces.begin(), faces.end(),
            [&](label facei) { return facei < complex.nInternalFaces(); }
        );
        nInside += inside;
        nFaces += inside * faces.size();
    }
    EXPECT_EQ(nInside, 4 * 2 * 5);
    EXPECT_EQ(nFaces / nInside, 14); // edges at a point of Kuhn's tetrahedra
}
