// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/particles/InstabilityParticles.H"

namespace Foam::stability
{

namespace
{

// p of any corner of the triangles around each point; (-1, -1) where none has one.
List<vector2D> pointParameters(const InterfaceMesh& mesh)
{
    List<vector2D> result(mesh.points.size(), vector2D(-1, -1));
    forAll(mesh.triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label parameteri = mesh.corners[trianglei][k];
            if (parameteri != InterfaceMesh::noParameter)
            {
                result[mesh.triangles[trianglei][k]] = mesh.parameters[parameteri];
            }
        }
    }
    return result;
}

// p in the centre: the mean of the corners, or that of the first corner that has one.
vector2D centreParameter(const InterfaceMesh& mesh, label trianglei)
{
    vector2D sum(0, 0);
    vector2D first(-1, -1);
    label n = 0;
    for (const label parameteri : mesh.corners[trianglei])
    {
        if (parameteri != InterfaceMesh::noParameter)
        {
            first = n == 0 ? mesh.parameters[parameteri] : first;
            sum += mesh.parameters[parameteri];
            ++n;
        }
    }
    return n == 3 ? sum / 3 : first;
}

} // namespace

void InstabilityParticles::seed(
    const InterfaceMesh& mesh, const UList<bool>& detached,
    const UList<label>& components, const CellComplex& complex, scalar time
)
{
    const auto add = [&](const point& x, label celli, const InstabilityParticle& what)
    {
        if (particles_.size() >= maxParticles_)
        {
            ++nSkipped_;
            return;
        }
        InstabilityParticle particle(what);
        particle.path.id = nextId_++;
        particle.path.x = x;
        particle.path.time = time;
        particle.path.hint.cell = celli < 0 ? celli : complex.globalCell(celli);
        particle.detachmentTime = time;
        particle.detachmentPosition = x;
        particle.nearWall = celli >= 0 && complex.nearWall(celli);
        particles_.append(particle);
    };

    const scalarField areas(mesh.pointAreas());
    const List<vector2D> parameters(pointParameters(mesh));
    forAll(mesh.points, pointi)
    {
        if (detached[pointi])
        {
            InstabilityParticle particle;
            particle.parameter = parameters[pointi];
            particle.origin = mesh.origins[pointi];
            particle.component = components[pointi];
            particle.weight = 0.5 * areas[pointi];
            add(mesh.points[pointi], mesh.cells[pointi], particle);
        }
    }
    forAll(mesh.triangles, trianglei)
    {
        const triFace& t = mesh.triangles[trianglei];
        if (detached[t[0]] || detached[t[1]] || detached[t[2]])
        {
            InstabilityParticle particle;
            particle.parameter = centreParameter(mesh, trianglei);
            particle.origin =
                (mesh.origins[t[0]] + mesh.origins[t[1]] + mesh.origins[t[2]]) / 3;
            particle.component = components[t[0]];
            particle.weight = 0.5 * mag(mesh.areaVector(trianglei));
            const point x = mesh.centre(trianglei);
            const label near = mesh.cells[t[0]];
            add(x, near >= 0 && complex.holds(near, x) ? near : complex.findCell(x),
                particle);
        }
    }
}

List<Pathline> InstabilityParticles::paths() const
{
    List<Pathline> result(particles_.size());
    forAll(particles_, i)
    {
        result[i] = particles_[i].path;
    }
    return result;
}

void InstabilityParticles::setPaths(const UList<Pathline>& paths)
{
    forAll(particles_, i)
    {
        particles_[i].path = paths[i];
    }
}

} // namespace Foam::stability
