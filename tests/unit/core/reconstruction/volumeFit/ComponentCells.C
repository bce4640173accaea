// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/volumeFit/ComponentCells.H"
#include "core/reconstruction/Reconstruction.H"
#include "shapes/ExactAlpha.H"
#include "shapes/PolyMeshes.H"

#include <gtest/gtest.h>

#include <algorithm>

using namespace Foam;
using namespace Foam::stability;

TEST(ComponentCells, allThatAComponentCutsAndNoneFarAway)
{
    shapes::BoxOptions options;
    options.max = point(16, 16, 16);
    options.n = Vector<label>(16, 16, 16);
    for (const CellComplexInput& input :
         {shapes::perturbedBox(options), shapes::tetrahedralBox(options)})
    {
        const auto complex = shapes::complexOf(input);
        const shapes::Shape balls = shapes::unionOf(
            shapes::sphere(point(4.6, 5.1, 7.2), 2.8),
            shapes::sphere(point(11.5, 8.3, 7.9), 2.1)
        );
        const InterfaceMesh mesh = Reconstruction::New(ReconstructionOptions())
                                       ->extract(shapes::snapshotOf(complex, balls))
                                       .mesh;
        const SurfaceComponents components(mesh);
        ASSERT_EQ(components.all.size(), 2u);
        ComponentCells finder(mesh, *complex);
        for (const SurfaceComponent& component : components.all)
        {
            std::vector<label> cells = finder.of(component);
            std::sort(cells.begin(), cells.end());
            EXPECT_TRUE(std::adjacent_find(cells.begin(), cells.end()) == cells.end());
            const ComponentColumns columns(mesh, component);
            label nCut = 0;
            for (label celli = 0; celli < complex->nCells(); ++celli)
            {
                const CellSolid cell(*complex, celli);
                const scalar share = columns.volumeIn(cell) / cell.volume();
                const bool cut = share > 1e-9 && share < 1 - 1e-9;
                nCut += cut;
                EXPECT_TRUE(
                    !cut || std::binary_search(cells.begin(), cells.end(), celli)
                );
            }
            EXPECT_GT(nCut, 50);
            EXPECT_LT(cells.size(), std::size_t(3 * nCut));
        }
    }
}
