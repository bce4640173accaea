// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "foam/ResultFolder.H"

#include "core/Errors.H"
#include "core/FileReplacement.H"
#include "foam/VtkLibrary.H"
#include "OSspecific.H"
#include "fileNameList.H"
#include "sigFpe.H"

#include <iomanip>
#include <sstream>

namespace Foam::stability
{

namespace
{

constexpr int textureSize = 1024; // [pixels]
const fileName previousName("previous");

std::unique_ptr<ResultWriter> openWriter()
{
    void* symbol = vtkEntryPoint("interfaceStabilityNewVtpWriter");
    const auto newWriter = reinterpret_cast<ResultWriter* (*)()>(symbol);
    return std::unique_ptr<ResultWriter>(newWriter());
}

// A part of the path that exists and is no folder; empty if there is none.
fileName obstacle(const fileName& path)
{
    for (fileName part = path; !part.empty() && part != "/" && part != ".";
         part = part.path())
    {
        if (isFile(part, false))
        {
            return part;
        }
    }
    return fileName();
}

std::string timeText(scalar time)
{
    std::ostringstream os;
    os << std::setprecision(15) << time;
    return os.str();
}

} // namespace

ResultFolder::ResultFolder(const fileName& path, label precision)
    : path_(path),
      stability_("Areas in m2, displacement in cells, speeds in m/s", precision),
      survival_(
          "Fractions of T (detached) and M (attached) farther away than so many cells",
          precision
      ),
      droplets_(
          "Droplets and bubbles below 1.5 cells: radius in cells, volume in m3, "
          "centroid in m",
          precision
      ),
      timing_(
          "Seconds of wall-clock time, by phase, since the last classified time",
          precision
      )
{
    const fileName inTheWay(obstacle(path_));
    if (!inTheWay.empty())
    {
        throw BadInput(
            inTheWay + " is a file, but the results belong into the folder " + path_
            + ": move the file away."
        );
    }
    stability_.setColumns(Statistics::columns());
    survival_.setColumns(Statistics::survivalColumns());
    droplets_.setColumns(Droplet::columns());
    std::vector<std::string> phases(phaseNames());
    phases.insert(phases.begin(), "time");
    timing_.setColumns(phases);
}

void ResultFolder::open()
{
    if (writer_)
    {
        return;
    }
    writer_ = openWriter();
    if (!mkDir(path_))
    {
        writer_.reset();
        throw std::runtime_error("Cannot make the folder " + path_ + ".");
    }
    putEarlierResultsAside();
    const sigFpe::ignore untrapped;
    writer_->writeTexture(path_ / "texture.png", textureSize);
}

// The lists and tables first: no moment shows lists of files that are gone.
std::vector<fileName> ResultFolder::results(const fileName& folder) const
{
    std::vector<fileName> names;
    for (const char* name :
         {"stability.dat", "survival.dat", "droplets.dat", "timing.dat"})
    {
        names.push_back(name);
    }
    for (const Family* family : {&interfaces_, &timeSurfaces_, &particles_})
    {
        names.push_back(family->name + ".vtp.series");
    }
    for (const Family* family : {&interfaces_, &timeSurfaces_, &particles_})
    {
        for (const fileName& file : readDir(folder, fileName::FILE, false))
        {
            const std::string stem = family->name + "_";
            if (file.compare(0, stem.size(), stem) == 0 && file.hasExt("vtp"))
            {
                names.push_back(file);
            }
        }
    }
    return names;
}

// A run that breaks off must not cost the results of the one before. Where there are
// such already, the results in place are those of a run that broke off.
void ResultFolder::putEarlierResultsAside() const
{
    const fileName aside(path_ / previousName);
    const bool kept = isDir(aside);
    for (const fileName& name : results(path_))
    {
        if (kept)
        {
            rm(path_ / name);
        }
        else if (isFile(path_ / name, false) && (isDir(aside) || mkDir(aside)))
        {
            mv(path_ / name, aside / name);
        }
    }
}

void ResultFolder::complete() const
{
    const fileName aside(path_ / previousName);
    if (!isDir(aside))
    {
        return;
    }
    for (const fileName& name : results(aside))
    {
        rm(aside / name);
    }
    rmDir(aside); // if nothing of the user's is in it
}

void ResultFolder::writeFamily(
    Family& family, const ResultSurface& surface, label index
)
{
    std::ostringstream name;
    name << family.name << '_' << std::setw(6) << std::setfill('0') << index << ".vtp";
    {
        const sigFpe::ignore untrapped; // VTK divides by zero at times
        writer_->writeVtp(path_ / name.str(), surface);
    }
    family.entries.push_back(
        "{ \"name\" : \"" + name.str() + "\", \"time\" : " + timeText(surface.time)
        + " }"
    );

    std::string text = "{\n  \"file-series-version\" : \"1.0\",\n  \"files\" : [\n";
    for (std::size_t i = 0; i < family.entries.size(); ++i)
    {
        const bool last = i + 1 == family.entries.size();
        text += "    " + family.entries[i] + (last ? "\n" : ",\n");
    }
    replaceFile(path_ / (family.name + ".vtp.series"), text + "  ]\n}\n");
}

void ResultFolder::writeSurfaces(
    const ClassifiedSurface& interface, const ClassifiedSurface& time,
    const Classification& c
)
{
    open();
    const scalar now = c.statistics.time;
    writeFamily(interfaces_, interfaceSurface(interface, now), c.index);
    writeFamily(timeSurfaces_, timeSurface(time, now), c.index);
}

void ResultFolder::writeParticles(
    const UList<InstabilityParticle>& particles, const Classification& c
)
{
    open();
    writeFamily(particles_, particleCloud(particles, c.statistics.time), c.index);
}

void ResultFolder::writeTables(const Classification& c)
{
    open();
    const Statistics& statistics = c.statistics;
    stability_.addRow(statistics.values());
    stability_.write(path_ / "stability.dat");
    survival_.addRow(statistics.survivalValues());
    survival_.write(path_ / "survival.dat");
    for (const Droplet& droplet : c.droplets)
    {
        droplets_.addRow(droplet.values(statistics.time));
    }
    droplets_.write(path_ / "droplets.dat");
}

void ResultFolder::writeTimings(scalar time, const std::vector<scalar>& seconds)
{
    if (time == timingRow_)
    {
        timing_.dropLastRow();
    }
    timingRow_ = time;
    std::vector<scalar> row(seconds);
    row.insert(row.begin(), time);
    timing_.addRow(row);
    timing_.write(path_ / "timing.dat");
}

} // namespace Foam::stability
