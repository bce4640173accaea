// SPDX-License-Identifier: GPL-3.0-or-later

#include "CaseFluid.H"

#include "CaseBoundary.H"
#include "Colours.H"
#include "Messages.H"
#include "Section.H"

#include <vtkCellData.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOpenFOAMReader.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <regex>
#include <vector>

namespace Foam::stability
{

namespace
{

namespace fs = std::filesystem;

std::string firstMatch(const fs::path& file, const char* pattern)
{
    const std::string text = textOf(file);
    std::smatch found;
    return std::regex_search(text, found, std::regex(pattern)) ? found[1].str() : "";
}

bool isAlpha(const std::string& name)
{
    const auto ends = [&](const std::string& end)
    {
        return name.size() > end.size()
               && name.compare(name.size() - end.size(), end.size(), end) == 0;
    };
    return name.rfind("alpha.", 0) == 0 && !ends(".orig") && !ends("_0")
           && !ends("Mean");
}

// The folder of a time; empty if there is none.
fs::path timeFolder(const fs::path& caseFolder, double time)
{
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(caseFolder, none))
    {
        const std::string name = entry.path().filename();
        char* end = nullptr;
        const double value = std::strtod(name.c_str(), &end);
        const double near = 1e-6 * std::max(1e-3, std::abs(time));
        if (!name.empty() && !*end && std::abs(value - time) <= near
            && entry.is_directory())
        {
            return entry.path();
        }
    }
    return {};
}

// A case with the same mesh and one field at one time: VTK's reader takes `alpha.orig`
// for `alpha` where both are there.
class SingleField
{
public:
    SingleField(const fs::path& caseFolder, const fs::path& field)
    {
        std::string name = fs::temp_directory_path() / "interfaceStabilityView.XXXXXX";
        if (!::mkdtemp(name.data()))
        {
            return;
        }
        path_ = name;
        std::error_code ignored;
        const fs::path from = fs::absolute(caseFolder), file = fs::absolute(field);
        const fs::path time = path_ / file.parent_path().filename();
        fs::create_directory(time, ignored);
        fs::create_directory_symlink(from / "system", path_ / "system", ignored);
        fs::create_directory_symlink(from / "constant", path_ / "constant", ignored);
        fs::create_symlink(file, time / file.filename(), ignored);
    }
    ~SingleField()
    {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    SingleField(const SingleField&) = delete;
    void operator=(const SingleField&) = delete;

    fs::path control() const { return path_ / "system" / "controlDict"; }

private:
    fs::path path_;
};

vtkSmartPointer<vtkUnstructuredGrid>
readCells(const fs::path& control, double time, const std::string& alpha)
{
    vtkNew<vtkOpenFOAMReader> reader;
    reader->SetFileName(control.c_str());
    reader->UpdateInformation();
    reader->DisableAllPatchArrays();
    reader->SetPatchArrayStatus("internalMesh", 1);
    reader->DisableAllCellArrays();
    reader->SetCellArrayStatus(alpha.c_str(), 1);
    reader->CreateCellToPointOff();
    reader->SetTimeValue(time);
    reader->Update();
    auto* blocks = reader->GetOutput();
    return blocks && blocks->GetNumberOfBlocks() > 0
               ? vtkUnstructuredGrid::SafeDownCast(blocks->GetBlock(0))
               : nullptr;
}

// From the background where there is none of the fluid to its colour.
vtkSmartPointer<vtkUnsignedCharArray> coloursOf(vtkDataArray& alpha)
{
    auto result = vtkSmartPointer<vtkUnsignedCharArray>::New();
    result->SetName("colour");
    result->SetNumberOfComponents(3);
    result->SetNumberOfTuples(alpha.GetNumberOfTuples());
    for (vtkIdType i = 0; i < alpha.GetNumberOfTuples(); ++i)
    {
        const double share = std::clamp(alpha.GetTuple1(i), 0.0, 1.0);
        for (int k = 0; k < 3; ++k)
        {
            const double shade = colours::background[k]
                                 + share * (colours::fluid[k] - colours::background[k]);
            result->SetComponent(i, k, std::round(255 * shade));
        }
    }
    return result;
}

} // namespace

CaseFluid::CaseFluid(const fs::path& caseFolder) : case_(caseFolder) {}

// The file of the volume fraction, whose name may end in .gz; empty if there is none.
fs::path CaseFluid::alphaAt(double time) const
{
    const fs::path folder = timeFolder(case_, time);
    std::string name = firstMatch(
        case_ / "system" / "interfaceStabilityDict", R"((?:^|\s)alpha\s+([^\s;]+);)"
    );
    if (name.empty())
    {
        name = firstMatch(
            case_ / "constant" / "transportProperties", R"(\bphases\s*\(\s*(\w+))"
        );
        name = name.empty() ? "" : "alpha." + name;
    }
    std::vector<fs::path> found;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none))
    {
        const fs::path file = entry.path().filename();
        const std::string field = file.extension() == ".gz" ? file.stem() : file;
        if (name.empty() ? isAlpha(field) : field == name)
        {
            found.push_back(entry.path());
        }
    }
    return found.size() == 1 ? found[0] : fs::path();
}

vtkSmartPointer<vtkPolyData> CaseFluid::shades(double time, const vtkVector3d& normal)
{
    const fs::path file = alphaAt(time);
    auto faces = vtkSmartPointer<vtkPolyData>::New();
    if (!file.empty())
    {
        const SingleField field(case_, file);
        const fs::path name = file.filename();
        const std::string alpha = name.extension() == ".gz" ? name.stem() : name;
        const auto cells = readCells(field.control(), time, alpha);
        vtkDataArray* values =
            cells ? cells->GetCellData()->GetArray(alpha.c_str()) : nullptr;
        if (values)
        {
            cells->GetCellData()->SetScalars(coloursOf(*values));
            vtkNew<vtkDataSetSurfaceFilter> surface;
            surface->SetInputData(cells);
            surface->Update();
            faces = facingFaces(*surface->GetOutput(), normal);
        }
    }
    const std::string error = takeError();
    if (!told_ && (faces->GetNumberOfPolys() == 0 || !error.empty()))
    {
        told_ = true;
        std::cerr << "Warning: the case has no volume fraction at time " << time
                  << " that can be read; the fluid is not shaded. " << error << '\n';
    }
    return faces;
}

} // namespace Foam::stability
