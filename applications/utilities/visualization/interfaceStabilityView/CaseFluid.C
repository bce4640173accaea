// SPDX-License-Identifier: GPL-3.0-or-later

#include "CaseFluid.H"

#include "CaseBoundary.H"
#include "Colours.H"
#include "Messages.H"
#include "Section.H"

#include <vtkCellData.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkDoubleArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
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

std::string alphaOf(const fs::path& caseFolder, vtkOpenFOAMReader& reader)
{
    const std::string asked = firstMatch(
        caseFolder / "system" / "interfaceStabilityDict",
        R"((?:^|\s)alpha\s+([^\s;]+);)"
    );
    const std::string phase = firstMatch(
        caseFolder / "constant" / "transportProperties", R"(\bphases\s*\(\s*(\w+))"
    );
    if (!asked.empty() || !phase.empty())
    {
        return asked.empty() ? "alpha." + phase : asked;
    }
    std::vector<std::string> found;
    for (int i = 0; i < reader.GetNumberOfCellArrays(); ++i)
    {
        if (isAlpha(reader.GetCellArrayName(i)))
        {
            found.push_back(reader.GetCellArrayName(i));
        }
    }
    return found.size() == 1 ? found[0] : "";
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

CaseFluid::CaseFluid(const fs::path& caseFolder)
{
    const fs::path control = caseFolder / "system" / "controlDict";
    std::error_code ignored;
    if (caseFolder.empty() || !fs::exists(control, ignored))
    {
        return;
    }
    reader_ = vtkSmartPointer<vtkOpenFOAMReader>::New();
    reader_->SetFileName(control.c_str());
    reader_->UpdateInformation();
    alpha_ = alphaOf(caseFolder, *reader_);
    reader_->DisableAllPatchArrays();
    reader_->SetPatchArrayStatus("internalMesh", 1);
    reader_->DisableAllPointArrays();
    reader_->DisableAllLagrangianArrays();
    reader_->DisableAllCellArrays();
    reader_->SetCellArrayStatus(alpha_.c_str(), 1);
    reader_->CreateCellToPointOff();
}

bool CaseFluid::hasTime(double time)
{
    vtkDoubleArray* times = reader_ ? reader_->GetTimeValues() : nullptr;
    for (vtkIdType i = 0; times && i < times->GetNumberOfTuples(); ++i)
    {
        if (std::abs(times->GetValue(i) - time)
            <= 1e-6 * std::max(1e-3, std::abs(time)))
        {
            reader_->SetTimeValue(times->GetValue(i));
            return true;
        }
    }
    return false;
}

vtkSmartPointer<vtkPolyData> CaseFluid::shades(double time, const vtkVector3d& normal)
{
    vtkDataArray* alpha = nullptr;
    vtkNew<vtkDataSetSurfaceFilter> surface;
    if (!alpha_.empty() && hasTime(time))
    {
        reader_->Update();
        auto* mesh = vtkUnstructuredGrid::SafeDownCast(
            vtkMultiBlockDataSet::SafeDownCast(reader_->GetOutput())->GetBlock(0)
        );
        if (mesh && mesh->GetCellData()->GetArray(alpha_.c_str()))
        {
            surface->SetInputData(mesh);
            surface->Update();
            alpha = surface->GetOutput()->GetCellData()->GetArray(alpha_.c_str());
        }
    }
    const std::string error = takeError();
    if (!alpha || !error.empty())
    {
        if (!told_)
        {
            std::cerr << "Warning: at time " << time << " the case has no "
                      << (alpha_.empty() ? "volume fraction" : alpha_)
                      << " that can be read; the fluid is not shaded. " << error
                      << '\n';
        }
        told_ = true;
        return vtkSmartPointer<vtkPolyData>::New();
    }
    const auto faces = facingFaces(*surface->GetOutput(), normal);
    faces->GetCellData()->SetScalars(
        coloursOf(*faces->GetCellData()->GetArray(alpha_.c_str()))
    );
    return faces;
}

} // namespace Foam::stability
