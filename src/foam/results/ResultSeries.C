// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/results/ResultSeries.H"

#include "core/base/FileReplacement.H"
#include "core/surface/pieces/PointNumbers.H"
#include "foam/vtk/VtkLibrary.H"
#include "OSspecific.H"
#include "fileNameList.H"
#include "sigFpe.H"

#include <iomanip>
#include <regex>
#include <sstream>

namespace Foam::stability
{

namespace
{

constexpr int textureSize = 1024; // [pixels]

std::string timeText(scalar time)
{
    std::ostringstream os;
    os << std::setprecision(15) << time;
    return os.str();
}

std::string numbered(const std::string& name, label index)
{
    std::ostringstream os;
    os << name << '_' << std::setw(6) << std::setfill('0') << index;
    return os.str();
}

std::string pieceOf(const std::string& name, label ranki)
{
    return name + '/' + std::to_string(ranki) + ".vtp";
}

} // namespace

ResultSeries::ResultSeries(
    const fileName& folder, SurfaceParts parts,
    const std::optional<PlaneSection>& section, const Exchange& exchange
)
    : folder_(folder), parts_(parts), section_(section), exchange_(exchange)
{
}

std::vector<fileName> ResultSeries::files(const fileName& folder)
{
    const std::string families = "(interface|timeSurface|particles)";
    const std::regex list(families + "\\.p?vtp\\.series"),
        one(families + "_[0-9]+\\.p?vtp"), pieces(families + "_[0-9]+");
    std::vector<fileName> found;
    const auto add = [&](fileName::Type type, const std::regex& pattern)
    {
        for (const fileName& name : readDir(folder, type, false))
        {
            if (std::regex_match(name, pattern))
            {
                found.push_back(name);
            }
        }
    };
    add(fileName::FILE, list);
    add(fileName::FILE, one);
    add(fileName::DIRECTORY, pieces);
    return found;
}

void ResultSeries::open()
{
    if (!writer_)
    {
        void* symbol = vtkEntryPoint("interfaceStabilityNewVtpWriter");
        writer_.reset(reinterpret_cast<ResultWriter* (*)()>(symbol)());
        if (exchange_.isMaster())
        {
            writer_->writeTexture(folder_ / "texture.png", textureSize);
        }
    }
}

void ResultSeries::list(Family& family, const std::string& file, scalar time) const
{
    family.entries.push_back(
        "{ \"name\" : \"" + file + "\", \"time\" : " + timeText(time) + " }"
    );
    std::string text = "{\n  \"file-series-version\" : \"1.0\",\n  \"files\" : [\n";
    for (std::size_t i = 0; i < family.entries.size(); ++i)
    {
        const bool last = i + 1 == family.entries.size();
        text += "    " + family.entries[i] + (last ? "\n" : ",\n");
    }
    const char* ending = parts_ == SurfaceParts::whole ? ".vtp" : ".pvtp";
    replaceFile(folder_ / (family.name + ending + ".series"), text + "  ]\n}\n");
}

ResultSurface ResultSeries::inMesh(ResultSurface surface) const
{
    if (section_)
    {
        moveIntoMesh(surface, *section_);
    }
    return surface;
}

void ResultSeries::writeWhole(Family& family, label index, const SurfaceMaker& make)
{
    runOnAllRanks(
        exchange_,
        [&]
        {
            if (exchange_.isMaster())
            {
                const sigFpe::ignore untrapped; // VTK divides by zero at times
                const ResultSurface surface(inMesh(make()));
                const std::string file = numbered(family.name, index) + ".vtp";
                open();
                writer_->writeVtp(folder_ / file, surface);
                list(family, file, surface.time);
            }
        }
    );
}

void ResultSeries::writePieces(Family& family, label index, const SurfaceMaker& make)
{
    const std::string name = numbered(family.name, index);
    const bool master = exchange_.isMaster();
    runOnAllRanks(
        exchange_,
        [&]
        {
            if (master && !mkDir(folder_ / name))
            {
                throw std::runtime_error(
                    "Cannot make the folder " + folder_ / name + "."
                );
            }
        }
    );
    ResultSurface surface;
    Packet written; // empty: nothing
    runOnAllRanks(
        exchange_,
        [&]
        {
            const sigFpe::ignore untrapped;
            surface = inMesh(make());
            if (master || !surface.points.empty())
            {
                open();
                writer_->writeVtp(folder_ / pieceOf(name, exchange_.rank()), surface);
                written.put(true);
            }
        }
    );
    const std::vector<Packet> all(exchange_.toMaster(std::move(written)));
    runOnAllRanks(
        exchange_,
        [&]
        {
            std::vector<std::string> pieces;
            for (std::size_t ranki = 0; ranki < all.size(); ++ranki)
            {
                if (!all[ranki].empty())
                {
                    pieces.push_back(pieceOf(name, label(ranki)));
                }
            }
            if (master)
            {
                writer_->writePvtp(folder_ / (name + ".pvtp"), surface, pieces);
                list(family, name + ".pvtp", surface.time);
            }
        }
    );
}

void ResultSeries::writeSurfaces(const Classification& c)
{
    const scalar time = c.statistics.time;
    const auto write = [&](Family& family, const ClassifiedSurface& mine, auto toFile)
    {
        if (parts_ == SurfaceParts::whole)
        {
            const ClassifiedSurface whole(gathered(mine, exchange_));
            writeWhole(
                family, c.index, [&] { return toFile(whole, time, labelList()); }
            );
        }
        else
        {
            const labelList numbers(pointNumbers(mine.order, exchange_));
            writePieces(family, c.index, [&] { return toFile(mine, time, numbers); });
        }
    };
    write(interfaces_, c.interface, interfaceSurface);
    write(timeSurfaces_, c.timeSurface, timeSurface);
}

void ResultSeries::writeParticles(
    const InstabilityParticles& particles, const Classification& c
)
{
    const scalar time = c.statistics.time;
    if (parts_ == SurfaceParts::whole)
    {
        const List<InstabilityParticle> all(particles.gathered(exchange_));
        writeWhole(particles_, c.index, [&] { return particleCloud(all, time); });
    }
    else
    {
        writePieces(
            particles_, c.index, [&] { return particleCloud(particles.here(), time); }
        );
    }
}

} // namespace Foam::stability
