// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/results/ResultSeries.H"

#include "core/base/FileOperations.H"
#include "core/base/FileReplacement.H"
#include "core/results/ParameterSpace.H"
#include "core/surface/pieces/PointNumbers.H"
#include "foam/vtk/VtkLibrary.H"
#include "sigFpe.H"

#include <cstdlib>
#include <iomanip>
#include <sstream>

namespace Foam::stability
{

namespace
{

constexpr int textureSize = 1024; // [pixels]

// As few digits as tell the time from all others.
std::string timeText(scalar time)
{
    std::string text;
    for (int digits = 15; digits <= 17; ++digits)
    {
        std::ostringstream os;
        os << std::setprecision(digits) << time;
        text = os.str();
        if (std::strtod(text.c_str(), nullptr) == time)
        {
            break;
        }
    }
    return text;
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
    const fileName& folder, const ResultSet* files, SurfaceParts parts,
    bool parameterSpace, const std::optional<PlaneSection>& section,
    const Exchange& exchange
)
    : folder_(folder), files_(files), parts_(parts), parameterSpace_(parameterSpace),
      section_(section), exchange_(exchange)
{
}

void ResultSeries::open()
{
    if (!writer_)
    {
        void* symbol = vtkEntryPoint("interfaceStabilityNewVtpWriter");
        writer_.reset(reinterpret_cast<ResultWriter* (*)()>(symbol)());
        if (exchange_.isMaster())
        {
            files_->add("texture.png");
            writer_->writeTexture(folder_ / "texture.png", textureSize);
        }
    }
}

std::string ResultSeries::listOf(const Family& family) const
{
    return family.name + (parts_ == SurfaceParts::whole ? ".vtp" : ".pvtp") + ".series";
}

void ResultSeries::list(Family& family, const std::string& file, scalar time) const
{
    if (family.entries.empty())
    {
        files_->add(listOf(family));
    }
    family.entries.push_back(
        "{ \"name\" : \"" + file + "\", \"time\" : " + timeText(time) + " }"
    );
    std::string text = "{\n  \"file-series-version\" : \"1.0\",\n  \"files\" : [\n";
    for (std::size_t i = 0; i < family.entries.size(); ++i)
    {
        const bool last = i + 1 == family.entries.size();
        text += "    " + family.entries[i] + (last ? "\n" : ",\n");
    }
    replaceFile(folder_ / listOf(family), text + "  ]\n}\n");
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
                files_->add(file);
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
            if (master)
            {
                files_->add(name + '/');
                files_->add(name + ".pvtp");
                makeFolders(folder_ / name);
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
    if (parameterSpace_)
    {
        write(
            parameterSpaces_, c.interface,
            [](const auto&... interface)
            { return parameterSpace(interfaceSurface(interface...)); }
        );
    }
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
