// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/case/CaseSnapshots.H"

#include "core/base/Errors.H"
#include "core/ranks/Exchange.H"
#include "foam/case/CaseChecks.H"
#include "OSspecific.H"
#include "fvMesh.H"

#include <sstream>

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

wordList namesOf(const instantList& times)
{
    wordList names(times.size());
    forAll(times, i)
    {
        names[i] = times[i].name();
    }
    return names;
}

// The names that each rank gives. Collective.
std::vector<wordList> fromAllRanks(const wordList& names, const Exchange& exchange)
{
    std::ostringstream text;
    for (const word& name : names)
    {
        text << name << ' ';
    }
    Packet packet;
    packet.putString(text.str());
    std::vector<wordList> all;
    for (Packet& one : exchange.toAll(packet))
    {
        std::istringstream words(one.getString());
        DynamicList<word> found;
        for (std::string name; words >> name;)
        {
            found.append(word(name));
        }
        all.push_back(wordList(std::move(found)));
    }
    return all;
}

// How a case comes to have two times.
std::string wayOut(const Time& runTime)
{
    const std::string decomposed = decomposedWayOut(runTime);
    if (!decomposed.empty())
    {
        return decomposed;
    }
    const fileName path(runTime.path());
    if (isDir(path / "0.orig") && !isDir(path / "0"))
    {
        return "there is 0.orig, but no 0; copy it (restore0Dir) and run the solver "
               "first.";
    }
    return "check the time options and the time folders of the case.";
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
      flux_(mesh, options.phi, options.velocity, source, messages),
      surfaces_(mesh.time(), options.files), reach_(reachOf(tracker)),
      cells_(std::make_unique<MeshSnapshots>(mesh, messages, reach_))
{
    for (const wordList& names : fromAllRanks({fields_.alphaName()}, messages))
    {
        if (names != wordList{fields_.alphaName()})
        {
            throw BadInput(
                "The ranks find different volume fractions: say which to analyse, for "
                "instance 'alpha "
                + fields_.alphaName() + ";'."
            );
        }
    }
    if (cells_->section())
    {
        refuseOnSection(options, tracker);
    }
}

instantList CaseSnapshots::select(const instantList& all)
{
    const instantList times(complete(all));
    if (times.size() < 2)
    {
        refuseTooFew(all, times.size());
    }
    runOnAllRanks(
        messages_,
        [&]
        {
            fields_.require(times);
            if (messages_.isMaster())
            {
                surfaces_.require(times);
            }
        }
    );
    flux_.choose(times);
    return times;
}

// Other programs leave folders of times without fields, a solver may write single
// fields, and a run that was killed may have left a time on some ranks only.
instantList CaseSnapshots::complete(const instantList& all)
{
    wordList here;
    runOnAllRanks(
        messages_,
        [&]
        {
            for (const instant& time : all)
            {
                if (!fields_.absentAt(time.name()))
                {
                    here.append(time.name());
                }
            }
        }
    );
    wordHashSet onAll(here);
    for (const wordList& names : fromAllRanks(here, messages_))
    {
        onAll &= wordHashSet(names);
    }
    wordHashSet onSome;
    for (const wordList& names : fromAllRanks(namesOf(all), messages_))
    {
        onSome |= wordHashSet(names);
    }
    onSome -= onAll;
    passedOver_ = onSome.sortedToc();

    DynamicList<instant> times;
    for (const instant& time : all)
    {
        if (onAll.found(time.name()))
        {
            times.append(time);
        }
    }
    return instantList(std::move(times));
}

// The reason comes first, if a field is missing or the whole case lies elsewhere.
void CaseSnapshots::refuseTooFew(const instantList& all, label nComplete) const
{
    std::string reason;
    runOnAllRanks(
        messages_,
        [&]
        {
            for (label i = 0; i < all.size() && reason.empty(); ++i)
            {
                reason = fields_.missingAt(all[i].name());
            }
        }
    );
    reason = messages_.firstNonEmpty(reason);
    throw BadInput(
        (reason.empty() ? "" : reason + " ") + "Times with all fields: "
        + std::to_string(nComplete) + " of " + std::to_string(all.size())
        + "; the analysis compares consecutive times and needs at least two: "
        + wayOut(mesh_.time())
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
    flux_.choose(times.empty() ? instantList() : complete(instantList(times)));
}

bool CaseSnapshots::passesOver()
{
    if (fields_.inMemory())
    {
        return false;
    }
    const word& now = mesh_.time().timeName();
    bool absent = false;
    runOnAllRanks(messages_, [&] { absent = fields_.absentAt(now); });
    absent = messages_.total(absent) > 0;
    if (absent && nTaken_ == 0)
    {
        // Those of later times are told at the first time that is taken.
        Info << "interfaceStability: time " << now << " is passed over: it has no "
             << fields_.alphaName() << " or no " << fields_.UName() << nl << endl;
    }
    return absent;
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

// Each rank has a file of its own that tells the time; one may be missing.
scalar CaseSnapshots::time() const
{
    scalar here = 0;
    runOnAllRanks(messages_, [&] { here = fields_.time(); });
    Packet packet;
    packet.put(here);
    return messages_.fromMaster(packet).get<scalar>();
}

std::shared_ptr<FlowSnapshot> CaseSnapshots::takeFields()
{
    std::optional<tmp<volScalarField>> alpha;
    std::optional<tmp<volVectorField>> U;
    std::optional<FaceFluxes> phi;
    runOnAllRanks(
        messages_,
        [&]
        {
            const std::string missing = fields_.missing();
            if (!missing.empty())
            {
                throw BadInput(missing);
            }
            alpha.emplace(fields_.alpha(messages_));
            U.emplace(fields_.U(messages_));
        }
    );
    if (!flux_.chosen())
    {
        chooseVelocity();
    }
    if (flux_.applies())
    {
        phi = flux_.get();
    }
    if (nTaken_ == 0)
    {
        findWalls((*U)());
    }
    return cells_->take((*alpha)(), (*U)(), time(), phi ? &*phi : nullptr);
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
