// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/case/CaseSnapshots.H"

#include "core/base/Errors.H"
#include "core/ranks/Exchange.H"
#include "fvMesh.H"

namespace Foam::stability
{

namespace
{

// If the reconstruction changes in time, the one that needs most decides.
FetchReach reachOf(const TrackerOptions& tracker)
{
    FetchReach reach(reachOf(tracker.reconstruction));
    for (const ReconstructionFrom& later : tracker.later)
    {
        const FetchReach other(reachOf(later.reconstruction));
        reach.nRings = max(reach.nRings, other.nRings);
        reach.cells = max(reach.cells, other.cells);
        reach.stencil = max(reach.stencil, other.stencil);
    }
    return reach;
}

// What does not know of two-dimensional meshes and wedges yet.
void refuseOnSection(const CaseOptions& options, const TrackerOptions& tracker)
{
    const auto refuseIf = [](bool given, const std::string& what)
    {
        if (given)
        {
            throw BadInput(
                what
                + " works on three-dimensional meshes only; this one is "
                  "two-dimensional "
                  "or a wedge."
            );
        }
    };
    for (const FilesFrom& files : options.files)
    {
        refuseIf(!files.pattern.empty(), "The reconstruction fromFiles");
    }
    const std::string fit = "The entry 'volumeFit component'";
    refuseIf(tracker.reconstruction.volumeFit != VolumeFit::none, fit);
    for (const ReconstructionFrom& later : tracker.later)
    {
        refuseIf(later.reconstruction.volumeFit != VolumeFit::none, fit);
    }
}

} // namespace

CaseSnapshots::CaseSnapshots(
    const fvMesh& mesh, const CaseOptions& options, const TrackerOptions& tracker,
    FieldSource source, const RankMessages& messages
)
    : mesh_(mesh), messages_(messages),
      fields_(makeOnAllRanks(
          messages, [&] { return CaseFields(mesh, options.alpha, options.U, source); }
      )),
      flux_(mesh, options.phi, options.velocity, source),
      surfaces_(mesh.time(), options.files), reach_(reachOf(tracker)),
      cells_(std::make_unique<MeshSnapshots>(mesh, messages, reach_))
{
    if (cells_->section())
    {
        refuseOnSection(options, tracker);
    }
}

void CaseSnapshots::require(const instantList& times)
{
    requireSame(times);
    if (times.size() < 2)
    {
        throw BadInput(
            "Times selected: " + std::to_string(times.size())
            + "; the analysis compares consecutive times and needs at least two: check "
              "the time options and the time folders of the case."
        );
    }
    runOnAllRanks(
        messages_,
        [&]
        {
            fields_.require(times);
            flux_.choose(times);
            if (messages_.isMaster())
            {
                surfaces_.require(times);
            }
        }
    );
}

// A run that was killed may have left a time on some ranks only.
void CaseSnapshots::requireSame(const instantList& times) const
{
    DynamicList<char> names;
    for (const instant& time : times)
    {
        names.append(List<char>(time.name().begin(), time.name().end()));
        names.append(' ');
    }
    Packet mine;
    mine.putList(names);
    const List<char> wanted(messages_.fromMaster(mine).getList<char>());
    runOnAllRanks(
        messages_,
        [&]
        {
            if (wanted != names)
            {
                throw BadInput(
                    "The folders of the ranks do not have the same times: remove those "
                    "that are not in all of processor0, processor1, ..."
                );
            }
        }
    );
}

// The velocity is chosen here if require() was not called: for a running solver or,
// where the fields are read from disk, for the present time and the later ones there.
void CaseSnapshots::chooseVelocity()
{
    const Time& runTime = mesh_.time();
    DynamicList<instant> times;
    if (!fields_.inMemory())
    {
        for (const instant& time : runTime.times())
        {
            const bool later =
                time.name() != runTime.constant() && time.value() > runTime.value();
            if (later || time.name() == runTime.timeName())
            {
                times.append(time);
            }
        }
    }
    flux_.choose(instantList(times));
}

std::shared_ptr<const FlowSnapshot> CaseSnapshots::take()
{
    std::shared_ptr<FlowSnapshot> snapshot(takeFields());
    const instant now(mesh_.time().value(), mesh_.time().timeName());
    if (surfaces_.expected(now))
    {
        runOnMaster(
            messages_, [&] { snapshot->surface = surfaces_.read(now, nTaken_); }
        );
    }
    ++nTaken_;
    return snapshot;
}

std::shared_ptr<FlowSnapshot> CaseSnapshots::takeFields()
{
    std::optional<tmp<volScalarField>> alpha;
    std::optional<tmp<volVectorField>> U;
    std::optional<tmp<surfaceScalarField>> phi;
    runOnAllRanks(
        messages_,
        [&]
        {
            const std::string missing = fields_.missing();
            if (!missing.empty())
            {
                throw BadInput(missing);
            }
            alpha.emplace(fields_.alpha());
            U.emplace(fields_.U());
            if (!flux_.chosen())
            {
                chooseVelocity();
            }
            if (flux_.applies())
            {
                phi.emplace(flux_.get());
            }
        }
    );
    if (nTaken_ == 0)
    {
        findWalls((*U)());
    }
    return cells_->take((*alpha)(), (*U)(), time(), phi ? &(*phi)() : nullptr);
}

// The first velocity tells; where the mesh knew better, it is not copied again.
void CaseSnapshots::findWalls(const volVectorField& U)
{
    walls_ = wallPatches(U, messages_);
    if (walls_.empty())
    {
        return;
    }
    wordHashSet names;
    for (const WallPatch& wall : walls_)
    {
        names.insert(wall.name);
    }
    cells_.reset();
    cells_ = std::make_unique<MeshSnapshots>(mesh_, messages_, reach_, names);
}

} // namespace Foam::stability
