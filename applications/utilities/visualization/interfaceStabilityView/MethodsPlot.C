// SPDX-License-Identifier: GPL-3.0-or-later

#include "MethodsPlot.H"

#include "Table.H"
#include "core/base/FileReplacement.H"

#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkColorSeries.h>
#include <vtkContextScene.h>
#include <vtkContextView.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlot.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>

namespace Foam::stability
{

namespace
{

// The distances [cells] of the columns detached(...).
std::vector<double> distancesOf(const TableRow& row)
{
    std::vector<double> distances;
    for (const auto& [name, value] : row)
    {
        double distance = 0;
        if (std::sscanf(name.c_str(), "detached(%lf)", &distance) == 1)
        {
            distances.push_back(distance);
        }
    }
    std::sort(distances.begin(), distances.end());
    return distances;
}

std::string columnName(const char* kind, double distance)
{
    char name[40];
    std::snprintf(name, sizeof name, "%s(%g)", kind, distance);
    return name;
}

// A column that a curve and its label need, but the row has not; empty if it has all.
std::string lacking(const TableRow& row)
{
    std::vector<std::string> needed{
        "stableFraction", "meanDistance", "area", "volumeError"};
    for (const double distance : distancesOf(row))
    {
        needed.push_back(columnName("detached", distance));
        needed.push_back(columnName("attached", distance));
    }
    const auto found = std::find_if(
        needed.begin(), needed.end(),
        [&](const std::string& name) { return row.count(name) == 0; }
    );
    return found == needed.end() ? std::string() : *found;
}

std::string label(const std::string& name, const TableRow& row)
{
    char text[200];
    std::snprintf(
        text, sizeof text,
        "%s: stable %.2f %%, mean distance %.3f cells, area %.4g m2, volume %.2f %% "
        "off",
        name.c_str(), 100 * row.at("stableFraction"), row.at("meanDistance"),
        row.at("area"), 100 * row.at("volumeError")
    );
    return text;
}

// From all of it at no distance, mean of both surfaces, in percent.
vtkSmartPointer<vtkTable> curve(const std::string& title, const TableRow& row)
{
    vtkNew<vtkDoubleArray> x, y;
    x->SetName("distance");
    y->SetName(title.c_str());
    x->InsertNextValue(0);
    y->InsertNextValue(100);
    for (const double distance : distancesOf(row))
    {
        x->InsertNextValue(distance);
        y->InsertNextValue(
            50
            * (row.at(columnName("detached", distance))
               + row.at(columnName("attached", distance)))
        );
    }
    auto table = vtkSmartPointer<vtkTable>::New();
    table->AddColumn(x);
    table->AddColumn(y);
    return table;
}

void setAxis(vtkAxis* axis, const char* title)
{
    axis->SetTitle(title);
    axis->GetTitleProperties()->SetFontSize(18);
    axis->GetTitleProperties()->BoldOff();
    axis->GetLabelProperties()->SetFontSize(16);
}

void draw(vtkContextView* view, const std::filesystem::path& picture)
{
    view->GetRenderWindow()->Render();
    vtkNew<vtkWindowToImageFilter> grab;
    grab->SetInput(view->GetRenderWindow());
    grab->ReadFrontBufferOff();
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(grab->GetOutputPort());
    writer->WriteToMemoryOn();
    writer->Write();
    if (!writer->GetResult())
    {
        throw std::runtime_error("Cannot draw " + picture.string() + ".");
    }
    replaceFile(
        picture.string(), writer->GetResult()->GetPointer(0),
        writer->GetResult()->GetNumberOfValues()
    );
}

std::vector<std::pair<std::string, TableRow>>
readMethods(const std::filesystem::path& table)
{
    const auto methods = readNamedRows(table);
    if (methods.empty() || distancesOf(methods.front().second).empty())
    {
        throw std::runtime_error(
            table.string()
            + " is no table of methods: interfaceStability writes it where "
              "its dictionary has the entry methods."
        );
    }
    for (const auto& [name, row] : methods)
    {
        const std::string column = lacking(row);
        if (!column.empty())
        {
            throw std::runtime_error(
                table.string() + " is no table of methods: it has no column " + column
                + "."
            );
        }
    }
    return methods;
}

} // namespace

std::filesystem::path
plotMethods(const std::filesystem::path& table, const std::array<int, 2>& size)
{
    const auto methods = readMethods(table);
    vtkNew<vtkContextView> view;
    view->GetRenderWindow()->SetMultiSamples(0);
    view->GetRenderWindow()->SetOffScreenRendering(1);
    view->GetRenderWindow()->SetSize(size[0], size[1]);
    view->GetRenderer()->SetBackground(1, 1, 1);
    vtkNew<vtkChartXY> chart;
    view->GetScene()->AddItem(chart);
    setAxis(
        chart->GetAxis(vtkAxis::BOTTOM), "distance between carried and found [cells]"
    );
    setAxis(
        chart->GetAxis(vtkAxis::LEFT), "share of the interface that is farther [%]"
    );
    chart->SetShowLegend(true);
    chart->GetLegend()->SetLabelSize(18);

    vtkNew<vtkColorSeries> colours;
    colours->SetColorScheme(vtkColorSeries::BREWER_QUALITATIVE_DARK2);
    std::vector<vtkSmartPointer<vtkTable>> kept;
    for (const auto& [name, row] : methods)
    {
        kept.push_back(curve(label(name, row), row));
        vtkPlot* plot = chart->AddPlot(vtkChart::LINE);
        plot->SetInputData(kept.back(), 0, 1);
        const vtkColor3ub c = colours->GetColorRepeating(int(kept.size()) - 1);
        plot->SetColor(c[0], c[1], c[2], 255);
        plot->SetWidth(3);
    }
    chart->GetAxis(vtkAxis::BOTTOM)->SetBehavior(vtkAxis::FIXED);
    chart->GetAxis(vtkAxis::BOTTOM)->SetRange(0, 1);
    chart->GetAxis(vtkAxis::LEFT)->SetBehavior(vtkAxis::FIXED);
    chart->GetAxis(vtkAxis::LEFT)->SetRange(0, 100);
    const std::filesystem::path picture = table.parent_path() / "methods.png";
    draw(view, picture);
    return picture;
}

} // namespace Foam::stability
