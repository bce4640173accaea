// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/advection/InstabilityParticles.H"
#include "shapes/BoxMesh.H"

#include <gtest/gtest.h>

using namespace Foam;
using namespace Foam::stability;

namespace
{

// A square sheet of n*n unevenly spaced points at z = 0.63 in the unit cube, p = (x,
// y).
InterfaceMesh sheet(const CellComplex& complex, label n)
{
    InterfaceMesh mesh;
    mesh.points.setSize(n * n);
    for (label j = 0; j < n; ++j)
    {
        for (label i = 0; i < n; ++i)
        {
            const scalar x = 0.1 + 0.68 * std::pow(scalar(i) / (n - 1), 1.3);
            const scalar y = 0.23 + 0.5 * scalar(j) / (n - 1);
            mesh.points[i + n * j] = point(x, y, 0.63);
        }
    }
    DynamicList<triFace> triangles;
    for (label j = 0; j + 1 < n; ++j)
    {
        for (label i = 0; i + 1 < n; ++i)
        {
            const label a = i + n * j;
            triangles.append(triFace(a, a + 1, a + n + 1));
            triangles.append(triFace(a, a + n + 1, a + n));
        }
    }
    mesh.triangles.transfer(triangles);
    mesh.clearParametrization();
    mesh.setOrigins(mesh.points + vector(0, 0, 0.1));
    mesh.parameters.setSize(n * n);
    mesh.cells.setSize(n * n);
    mesh.boundaryFaces.setSize(n * n, -1);
    mesh.cellSizes.setSize(n * n, 0.2);
    forAll(mesh.points, i)
    {
        mesh.parameters[i] = vector2D(mesh.points[i].x(), mesh.points[i].y());
        mesh.cells[i] = complex.findCell(mesh.points[i]);
    }
    forAll(mesh.triangles, i)
    {
        const triFace& t = mesh.triangles[i];
        mesh.corners[i][0] = t[0];
        mesh.corners[i][1] = t[1];
        mesh.corners[i][2] = t[2];
    }
    return mesh;
}

scalar totalWeight(const InstabilityParticles& particles)
{
    scalar sum = 0;
    for (const InstabilityParticle& particle : particles.here())
    {
        sum += particle.weight;
    }
    return sum;
}

const SerialExchange alone;

void shed(
    InstabilityParticles& particles, const InterfaceMesh& mesh,
    const List<Stability>& classes, label component, const CellComplex& complex,
    scalar time
)
{
    const SurfaceHalo halo(wholeSurface(mesh), VoxelMask(1), alone);
    const label n = mesh.points.size();
    ClassifiedSurface surface;
    surface.mesh = halo.mesh();
    surface.stability.setSize(n);
    forAll(classes, pointi)
    {
        surface.stability[halo.placeOf(pointi)] = classes[pointi];
    }
    surface.components = labelList(n, component);
    surface.areas = halo.mesh().pointAreas();
    surface.isPrimary = halo.primaryPoints();
    particles.seed(surface, halo, complex, time, alone);
}

void detach(
    InstabilityParticles& particles, const InterfaceMesh& mesh,
    const List<bool>& detached, label component, const CellComplex& complex, scalar time
)
{
    List<Stability> classes(detached.size(), Stability::stable);
    forAll(detached, pointi)
    {
        if (detached[pointi])
        {
            classes[pointi] = Stability::detached;
        }
    }
    shed(particles, mesh, classes, component, complex, time);
}

} // namespace

// Half of the area by points, half by triangles: all of it, at any resolution.
TEST(InstabilityParticles, weightsOfADetachedSheetAddUpToItsArea)
{
    const auto complex = shapes::unitCube(5);
    for (const label n : {4, 9})
    {
        const InterfaceMesh mesh(sheet(*complex, n));
        InstabilityParticles particles(100000);
        detach(particles, mesh, List<bool>(n * n, true), 3, *complex, 0.25);
        EXPECT_EQ(particles.here().size(), n * n + 2 * (n - 1) * (n - 1));
        EXPECT_NEAR(totalWeight(particles), 0.68 * 0.5, 1e-14);
    }
}

TEST(InstabilityParticles, rememberWhereTheyCameFrom)
{
    const auto complex = shapes::unitCube(5);
    const InterfaceMesh mesh(sheet(*complex, 6));
    List<bool> detached(36, false);
    detached[14] = true;
    InstabilityParticles particles(1000);
    detach(particles, mesh, detached, 3, *complex, 0.25);

    ASSERT_EQ(
        particles.here().size(), 1 + 6
    ); // the point and the six triangles around it
    EXPECT_EQ(particles.here()[0].path.x, mesh.points[14]);
    for (const InstabilityParticle& particle : particles.here())
    {
        EXPECT_EQ(particle.detachmentTime, 0.25);
        EXPECT_EQ(particle.path.time, 0.25);
        EXPECT_EQ(particle.component, 3);
        EXPECT_EQ(particle.detachmentPosition, particle.path.x);
        // p = (x, y) and origin = x + 0.1 k are linear: exact in the centres too.
        EXPECT_NEAR(particle.parameter.x(), particle.path.x.x(), 1e-14);
        EXPECT_NEAR(particle.parameter.y(), particle.path.x.y(), 1e-14);
        EXPECT_LT(mag(particle.origin - particle.path.x - vector(0, 0, 0.1)), 1e-14);
        EXPECT_TRUE(complex->holds(particle.path.hint.cell, particle.path.x));
    }
    forAll(particles.here(), i)
    {
        EXPECT_EQ(particles.here()[i].path.id, i);
    }
}

TEST(InstabilityParticles, areNotShedAtUntrackedPoints)
{
    const auto complex = shapes::unitCube(5);
    const InterfaceMesh mesh(sheet(*complex, 6));
    List<Stability> classes(36, Stability::stable);
    classes[14] = Stability::detached;
    classes[15] = Stability::untracked;
    InstabilityParticles particles(1000);
    shed(particles, mesh, classes, 3, *complex, 0.25);
    // The detached point and the four of its triangles without the untracked one.
    EXPECT_EQ(particles.here().size(), 1 + 4);
    for (const InstabilityParticle& particle : particles.here())
    {
        EXPECT_NE(particle.path.x, mesh.points[15]);
    }
}

TEST(InstabilityParticles, knowWhetherAWallWasNear)
{
    const auto complex = shapes::unitCube(5); // walls all around, cells of 0.2
    const InterfaceMesh mesh(sheet(*complex, 8));
    InstabilityParticles particles(1000);
    detach(particles, mesh, List<bool>(64, true), 0, *complex, 0);
    label n = 0;
    for (const InstabilityParticle& particle : particles.here())
    {
        // y and z keep away from the walls.
        EXPECT_EQ(particle.nearWall, particle.path.x.x() < 0.2);
        n += particle.nearWall;
    }
    EXPECT_GT(n, 0);
}

TEST(InstabilityParticles, aCornerWithoutParameterDoesNotSpoilTheOthers)
{
    const auto complex = shapes::unitCube(5);
    InterfaceMesh mesh(sheet(*complex, 4));
    mesh.corners[0][1] = InterfaceMesh::noParameter;
    List<bool> detached(16, true);
    InstabilityParticles particles(1000);
    detach(particles, mesh, detached, 0, *complex, 0);
    const InstabilityParticle& centre = particles.here()[16];
    EXPECT_EQ(centre.parameter.x(), mesh.points[0].x());

    mesh.corners = CornerIndices(InterfaceMesh::noParameter);
    InstabilityParticles none(1000);
    detach(none, mesh, detached, 0, *complex, 0);
    for (const InstabilityParticle& particle : none.here())
    {
        EXPECT_EQ(particle.parameter.x(), -1);
    }
}

TEST(InstabilityParticles, theCapCountsWhatItTurnsAway)
{
    const auto complex = shapes::unitCube(5);
    const InterfaceMesh mesh(sheet(*complex, 4));
    InstabilityParticles particles(20);
    detach(particles, mesh, List<bool>(16, true), 0, *complex, 0);
    EXPECT_EQ(particles.here().size(), 20);
    EXPECT_EQ(particles.nSkipped(), 16 + 18 - 20);
}
