// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/cells/SectionExtrusion.H"

#include "core/base/Errors.H"
#include "shapes/BoxMesh.H"

#include <gtest/gtest.h>

#include <map>

namespace Foam::stability
{

namespace
{

// A layer across y of 6 x 4 cells whose points are moved within the plane.
CellComplexInput layer(scalar thickness)
{
    shapes::BoxOptions options;
    options.min = point(1, 2, 3);
    options.max = point(2, 2 + thickness, 4);
    options.n = Vector<label>(6, 1, 4);
    options.kinds[0] = BoundaryKind::open;
    options.map = [](const point& x)
    { return x + vector(0.03 * std::sin(9 * x.z()), 0, 0.02 * std::cos(7 * x.x())); };
    CellComplexInput mesh(shapes::boxInput(options));
    mesh.globalCells = identity(mesh.nCells);
    mesh.globalPoints = identity(mesh.points.size()) + label(100);
    mesh.cellBehind = labelList(mesh.kinds.size(), -1);
    return mesh;
}

LayerEnds endsOf(const CellComplexInput& mesh, const PlaneSection& section)
{
    LayerEnds ends;
    ends.low.setSize(mesh.nCells, -1);
    ends.high.setSize(mesh.nCells, -1);
    forAll(mesh.kinds, i)
    {
        const label facei = mesh.neighbour.size() + i;
        const vector area(mesh.faces[facei].areaNormal(mesh.points));
        if (mag(area & section.normal) > 0.9 * mag(area))
        {
            labelList& side = (area & section.normal) < 0 ? ends.low : ends.high;
            side[mesh.owner[facei]] = facei;
        }
    }
    return ends;
}

PlaneSection sectionOf(scalar meshThickness)
{
    PlaneSection section;
    section.normal = vector(0, 1, 0);
    section.middle = 2 + 0.5 * meshThickness;
    section.meshThickness = meshThickness;
    section.thickness = 0.2;
    return section;
}

// A wedge of one row of cells along x: one cell from the axis to r = 1, one beyond.
CellComplexInput wedgeRow()
{
    const scalar slope = 0.05;
    CellComplexInput mesh;
    mesh.nCells = 2;
    for (const scalar x : {0, 1})
    {
        mesh.points.append(point(x, 0, 0));
        for (const scalar r : {1, 2})
        {
            mesh.points.append(point(x, r, -slope * r));
            mesh.points.append(point(x, r, slope * r));
        }
    }
    const auto f = [](std::initializer_list<label> points)
    { return face(labelList(points)); };
    mesh.faces = {
        f({1, 2, 7, 6}),               // internal, r = 1
        f({0, 5, 6, 1}).reverseFace(), // low, cell 0
        f({0, 2, 7, 5}).reverseFace(), // high, cell 0
        f({1, 6, 8, 3}).reverseFace(), // low, cell 1
        f({2, 4, 9, 7}).reverseFace(), // high, cell 1
        f({0, 2, 1}),
        f({5, 6, 7}), // ends along x, cell 0
        f({1, 2, 4, 3}),
        f({6, 8, 9, 7}),  // and cell 1
        f({3, 4, 9, 8})}; // outside
    mesh.owner = {0, 0, 0, 1, 1, 0, 0, 1, 1, 1};
    mesh.neighbour = {1};
    mesh.kinds.setSize(9, BoundaryKind::open);
    mesh.patches.setSize(9, 0);
    mesh.patchNames = {"all"};
    mesh.globalCells = identity(2);
    mesh.globalPoints = identity(10);
    mesh.cellBehind = labelList(9, -1);
    return mesh;
}

} // namespace

// Whatever the thickness, the prisms are those of the section: the same to the last bit
// but for where they lie across.
TEST(SectionExtrusion, aLayerGivesItsPrisms)
{
    const CellComplexInput mesh(layer(7));
    const PlaneSection section(sectionOf(7));
    const LayerEnds ends(endsOf(mesh, section));
    const ExtrudedSection extruded(extrudedSection(mesh, ends, section));
    ASSERT_EQ(extruded.prisms.points.size(), mesh.points.size());
    ASSERT_EQ(extruded.prisms.faces.size(), mesh.faces.size());
    EXPECT_EQ(extruded.prisms.globalCells, mesh.globalCells);
    forAll(extruded.prisms.points, i)
    {
        const label meshi = extruded.meshPoints[i];
        EXPECT_EQ(
            extruded.prisms.globalPoints[i], 2 * mesh.globalPoints[meshi] + i % 2
        );
        EXPECT_EQ(
            section.inMiddle(extruded.prisms.points[i]),
            section.inMiddle(mesh.points[meshi])
        );
        EXPECT_NEAR(extruded.prisms.points[i].y(), 5.5 + (i % 2 ? 0.1 : -0.1), 1e-14);
    }
    const CellComplex prisms(extruded.prisms), real(mesh);
    for (label celli = 0; celli < mesh.nCells; ++celli)
    {
        EXPECT_NEAR(
            prisms.cellVolumes()[celli], real.cellVolumes()[celli] * 0.2 / 7, 1e-14
        );
        EXPECT_LT(mag(prisms.cellCentres()[celli] - real.cellCentres()[celli]), 1e-14);
    }
    forAll(extruded.meshFaces, facei)
    {
        const label meshi = extruded.meshFaces[facei];
        const bool isEnd = ends.low.found(meshi) || ends.high.found(meshi);
        EXPECT_EQ(extruded.prisms.owner[facei], mesh.owner[meshi]);
        const vector area(
            prisms.faceAreas()[facei] * (isEnd ? 1 : 7 / 0.2) - real.faceAreas()[meshi]
        );
        EXPECT_LT(mag(area), 1e-12) << facei;
        const label i = facei - extruded.prisms.neighbour.size();
        if (i >= 0)
        {
            const label meshBoundary = meshi - mesh.neighbour.size();
            EXPECT_EQ(extruded.prisms.patches[i], mesh.patches[meshBoundary]);
            EXPECT_TRUE(
                extruded.prisms.kinds[i]
                == (isEnd ? BoundaryKind::symmetry : mesh.kinds[meshBoundary])
            );
        }
        else
        {
            EXPECT_EQ(extruded.prisms.neighbour[facei], mesh.neighbour[meshi]);
        }
    }
}

// Points on the axis become two, and the edges there faces of their own.
TEST(SectionExtrusion, aWedgeHasFacesOnItsAxis)
{
    const CellComplexInput mesh(wedgeRow());
    PlaneSection section;
    section.normal = vector(0, 0, 1);
    section.thickness = 0.5;
    section.meshThickness = 0.1;
    section.wedge = true;
    section.axis = vector(-1, 0, 0);
    const ExtrudedSection extruded(extrudedSection(mesh, endsOf(mesh, section), section)
    );
    const CellComplex prisms(extruded.prisms);
    ASSERT_EQ(prisms.nCells(), 2);
    EXPECT_EQ(prisms.nPoints(), 12);
    EXPECT_EQ(prisms.nFaces(), 11);
    EXPECT_NEAR(prisms.cellVolumes()[0], 0.5, 1e-14);
    EXPECT_NEAR(prisms.cellVolumes()[1], 0.5, 1e-14);
    const CellComplex real(mesh);
    label nAxis = 0;
    forAll(extruded.meshFaces, facei)
    {
        const point& centre = prisms.faceCentres()[facei];
        const label meshFacei = extruded.meshFaces[facei];
        if (meshFacei < 0)
        {
            ++nAxis;
            EXPECT_LT(mag(centre - point(0.5, 0, 0)), 1e-14);
            EXPECT_LT(mag(prisms.faceAreas()[facei] - vector(0, -0.5, 0)), 1e-14);
            EXPECT_TRUE(
                extruded.prisms.kinds[facei - prisms.nInternalFaces()]
                == BoundaryKind::symmetry
            );
        }
        else if (mag(prisms.faceAreas()[facei].z()) < 0.1)
        {
            EXPECT_LT(
                mag(section.factor(centre) * prisms.faceAreas()[facei]
                    - real.faceAreas()[meshFacei]),
                1e-14
            );
        }
    }
    EXPECT_EQ(nAxis, 1);
    // Each point of the section lies in the mesh where it was.
    forAll(extruded.meshPoints, i)
    {
        const point inMesh(section.inMesh(extruded.prisms.points[i]));
        const point& low = mesh.points[extruded.meshPoints[i]];
        EXPECT_LT(
            mag(inMesh - point(low.x(), low.y(), i % 2 ? -low.z() : low.z())), 1e-14
        );
    }
}

TEST(SectionExtrusion, aCellThatIsNoPrismIsRefused)
{
    CellComplexInput mesh(wedgeRow());
    PlaneSection section;
    section.normal = vector(0, 0, 1);
    const LayerEnds ends(endsOf(mesh, section));
    EXPECT_THROW(extrudedSection(mesh, ends, section), BadInput); // it has an axis
}

} // namespace Foam::stability
