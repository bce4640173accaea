// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/case/SurfaceFiles.H"

#include "core/base/Errors.H"
#include "core/reconstruction/Reconstruction.H"
#include "foam/vtk/VtkLibrary.H"
#include "OSspecific.H"
#include "Time.H"
#include "sigFpe.H"

#include <iomanip>
#include <sstream>

namespace Foam::stability
{

namespace
{

const std::string timePlace("<time>");
const std::string indexPlace("<index>");

std::string replaced(std::string text, const std::string& what, const std::string& by)
{
    for (auto at = text.find(what); at != text.npos;
         at = text.find(what, at + by.size()))
    {
        text.replace(at, what.size(), by);
    }
    return text;
}

} // namespace

SurfaceFiles::SurfaceFiles(const Time& time, const std::vector<FilesFrom>& files)
    : time_(time), files_(files)
{
}

std::string SurfaceFiles::patternAt(const instant& time) const
{
    std::string pattern;
    for (const FilesFrom& files : files_)
    {
        pattern = hasBegun(files.from, time.value()) ? files.pattern : pattern;
    }
    return pattern;
}

bool SurfaceFiles::isPattern(const std::string& text)
{
    const auto ends = [&](const std::string& end)
    {
        return text.size() > end.size()
               && text.compare(text.size() - end.size(), end.size(), end) == 0;
    };
    return (ends(".vtp") || ends(".stl") || ends(".obj"))
           && (text.find(timePlace) != text.npos || text.find(indexPlace) != text.npos);
}

std::string SurfaceFiles::allowed()
{
    return "a name with <time> or <index> in it that ends in .vtp, .stl or .obj";
}

fileName SurfaceFiles::path(const instant& time, label index) const
{
    std::ostringstream number;
    number << std::setw(6) << std::setfill('0') << index;
    const std::string name = replaced(
        replaced(patternAt(time), timePlace, time.name()), indexPlace, number.str()
    );
    return name[0] == '/' ? fileName(name) : time_.globalPath() / fileName(name);
}

void SurfaceFiles::requireFile(const fileName& file, const word& timeName) const
{
    if (!isFile(file, false))
    {
        throw BadInput(
            "There is no file " + file
            + ", which the reconstruction fromFiles needs at "
              "time "
            + timeName + "."
        );
    }
}

void SurfaceFiles::require(const instantList& times) const
{
    forAll(times, i)
    {
        if (expected(times[i]))
        {
            requireFile(path(times[i], i), times[i].name());
        }
    }
}

std::shared_ptr<const GivenSurface> SurfaceFiles::read(const instant& time, label index)
{
    const fileName file(path(time, index));
    requireFile(file, time.name());
    const sigFpe::ignore untrapped;
    if (!reader_)
    {
        void* symbol = vtkEntryPoint("interfaceStabilityNewSurfaceReader");
        reader_.reset(reinterpret_cast<SurfaceReader* (*)()>(symbol)());
    }
    return std::make_shared<const GivenSurface>(reader_->read(file));
}

} // namespace Foam::stability
