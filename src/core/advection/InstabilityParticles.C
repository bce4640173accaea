// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/advection/InstabilityParticles.H"

#include "core/flow/Travel.H"
#include "core/surface/Ribbon.H"
#include "core/surface/pieces/KeyOrder.H"

#include <algorithm>

namespace Foam::stability
{

namespace
{

// The values of T that a particle shed at a point stores.
struct Provenance
{
    vector2D parameter{-1, -1};
    point origin{Zero}; // [m]
};

// p and the origin of the last corner at each point that has p, or, where none has, the
// origin of any.
std::vector<Provenance> provenances(const InterfaceMesh& mesh)
{
    std::vector<Provenance> result(mesh.points.size());
    std::vector<bool> hasP(mesh.points.size(), false);
    forAll(mesh.triangles, trianglei)
    {
        for (label k = 0; k < 3; ++k)
        {
            const label pointi = mesh.triangles[trianglei][k];
            const label parameteri = mesh.corners[trianglei][k];
            Provenance& there = result[pointi];
            if (parameteri != InterfaceMesh::noParameter)
            {
                there = {mesh.parameters[parameteri], mesh.origin(trianglei, k)};
                hasP[pointi] = true;
            }
            else if (!hasP[pointi])
            {
                there.origin = mesh.origin(trianglei, k);
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

// A particle that is still to find its cell.
struct Seed
{
    InstabilityParticle particle;
    bool near = false; // the cell that its hint names is only near
};

Pathline& pathOf(Seed& seed)
{
    return seed.particle.path;
}

// The particles shed by a rank's piece of T, at its points and at centres of triangles.
class Seeding
{
public:
    Seeding(
        const ClassifiedSurface& surface, const SurfaceHalo& halo,
        const std::optional<PlaneSection>& section
    )
        : surface_(surface), mesh_(surface.mesh), halo_(halo), section_(section),
          pairs_(
              section ? pairsAcross(mesh_, *section) : identity(mesh_.points.size())
          ),
          mates_(
              section ? stripMates(mesh_, pairs_, *section)
                      : identity(mesh_.triangles.size())
          )
    {
        addPoints();
        addTriangles();
    }

    DynamicList<Seed> points, triangles;
    DynamicList<TriangleKey> pointKeys, triangleKeys;

private:
    // In two dimensions a pair of points, or the two triangles of a strip, shed one
    // particle, which lies between them.
    static void between(InstabilityParticle& particle, const InstabilityParticle& other)
    {
        particle.path.x = 0.5 * (particle.path.x + other.path.x);
        particle.origin = 0.5 * (particle.origin + other.origin);
        particle.weight += other.weight;
        if (particle.parameter.x() >= 0 && other.parameter.x() >= 0)
        {
            particle.parameter = 0.5 * (particle.parameter + other.parameter);
        }
    }

    void place(InstabilityParticle& particle) const
    {
        particle.path.x =
            section_ ? section_->inMiddle(particle.path.x) : particle.path.x;
    }

    InstabilityParticle atPoint(label pointi, const Provenance& known) const
    {
        InstabilityParticle particle;
        particle.path.x = mesh_.points[pointi];
        particle.path.hint.cell = mesh_.cells[pointi];
        particle.parameter = known.parameter;
        particle.origin = known.origin;
        particle.component = surface_.components[pointi];
        markAs(surface_, pointi, particle);
        particle.weight = 0.5 * surface_.areas[pointi];
        return particle;
    }

    InstabilityParticle atTriangle(label trianglei) const
    {
        const triFace& t = mesh_.triangles[trianglei];
        InstabilityParticle particle;
        particle.path.x = mesh_.centre(trianglei);
        particle.path.hint.cell = mesh_.cells[t[0]];
        particle.parameter = centreParameter(mesh_, trianglei);
        particle.origin = (mesh_.origin(trianglei, 0) + mesh_.origin(trianglei, 1)
                           + mesh_.origin(trianglei, 2))
                          / 3;
        particle.component = surface_.components[t[0]];
        markAs(
            surface_,
            detached(t[0])   ? t[0]
            : detached(t[1]) ? t[1]
                             : t[2],
            particle
        );
        particle.weight = 0.5 * areaInMesh(mesh_, trianglei, section_);
        return particle;
    }

    bool detached(label pointi) const
    {
        return surface_.stability[pointi] == Stability::detached;
    }

    // No triangle of such a corner says where the flow carried it.
    bool untracked(label pointi) const
    {
        return surface_.stability[pointi] == Stability::untracked;
    }

    // Each point gets the key of its first triangle, which is own for primary points.
    void addPoints()
    {
        const std::vector<Provenance> known(provenances(mesh_));
        List<bool> met(mesh_.points.size(), false);
        forAll(mesh_.triangles, trianglei)
        {
            for (label k = 0; k < 3; ++k)
            {
                const label pointi = mesh_.triangles[trianglei][k];
                const label other = pairs_[pointi];
                if (met[pointi] || !surface_.isPrimary[pointi] || !detached(pointi))
                {
                    continue;
                }
                met[pointi] = met[other] = true;
                Seed seed;
                seed.particle = atPoint(pointi, known[pointi]);
                if (other != pointi)
                {
                    between(seed.particle, atPoint(other, known[other]));
                }
                place(seed.particle);
                points.append(seed);
                TriangleKey key(halo_.piece().keys[trianglei]);
                key.place = 3 * key.place + k;
                pointKeys.append(key);
            }
        }
    }

    void addTriangles()
    {
        forAll(mesh_.triangles, trianglei)
        {
            const triFace& t = mesh_.triangles[trianglei];
            const label mate = mates_[trianglei];
            if (!halo_.isOwn(trianglei)
                || !(detached(t[0]) || detached(t[1]) || detached(t[2]))
                || untracked(t[0]) || untracked(t[1]) || untracked(t[2])
                || mate < trianglei)
            {
                continue;
            }
            Seed seed;
            seed.near = true;
            seed.particle = atTriangle(trianglei);
            if (mate != trianglei)
            {
                between(seed.particle, atTriangle(mate));
            }
            place(seed.particle);
            triangles.append(seed);
            triangleKeys.append(halo_.piece().keys[trianglei]);
        }
    }

    const ClassifiedSurface& surface_;
    const InterfaceMesh& mesh_;
    const SurfaceHalo& halo_;
    const std::optional<PlaneSection>& section_;
    labelList pairs_; // of points
    labelList mates_; // of triangles
};

} // namespace

void InstabilityParticles::seed(
    const ClassifiedSurface& timeSurface, const SurfaceHalo& halo,
    const CellComplex& complex, scalar time, const Exchange& exchange
)
{
    Seeding seeding(timeSurface, halo, complex.whole().section);
    DynamicList<Seed> seeds;
    const auto number = [&](const UList<TriangleKey>& keys, DynamicList<Seed>& some)
    {
        const labelList places(placesInOrder(keys, exchange));
        forAll(some, i)
        {
            some[i].particle.path.id = nextId_ + places[i];
            if (some[i].particle.path.id < maxParticles_)
            {
                seeds.append(some[i]);
            }
        }
        const label n = exchange.total(some.size());
        const label room = std::max(maxParticles_ - nextId_, label(0));
        nSkipped_ += std::max(n - room, label(0));
        nextId_ += std::min(n, room);
    };
    number(seeding.pointKeys, seeding.points);
    number(seeding.triangleKeys, seeding.triangles);

    disperse(seeds, complex, exchange);
    runOnAllRanks(
        exchange,
        [&]
        {
            for (Seed& seed : seeds)
            {
                label& celli = pathOf(seed).hint.cell;
                const point& x = pathOf(seed).x;
                if (seed.near && !(celli >= 0 && complex.holds(celli, x)))
                {
                    celli = complex.findCell(x);
                }
            }
        }
    );
    leaveImages(seeds, complex, exchange);
    runOnAllRanks(
        exchange,
        [&]
        {
            for (Seed& seed : seeds)
            {
                InstabilityParticle& particle = seed.particle;
                const label celli = particle.path.hint.cell;
                const point& x = particle.path.x;
                particle.path.time = time;
                particle.detachmentTime = time;
                particle.detachmentPosition = x;
                particle.nearWall = celli >= 0 && complex.nearWall(celli);
                particles_.append(particle);
            }
        }
    );
}

IntegrationCounts InstabilityParticles::advance(
    const Velocity& velocity, const IntegrationOptions& options,
    const CellComplex& complex, const Exchange& exchange
)
{
    return travel(particles_, velocity, options, complex, exchange);
}

List<InstabilityParticle> InstabilityParticles::gathered(const Exchange& exchange) const
{
    DynamicList<InstabilityParticle> all(exchange.joinedOnMaster(here()));
    std::sort(
        all.begin(), all.end(),
        [](const InstabilityParticle& a, const InstabilityParticle& b)
        { return a.path.id < b.path.id; }
    );
    return List<InstabilityParticle>(std::move(all));
}

} // namespace Foam::stability
