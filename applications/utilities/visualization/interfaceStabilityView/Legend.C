// SPDX-License-Identifier: GPL-3.0-or-later

#include "Legend.H"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRegularPolygonSource.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace Foam::stability
{

namespace
{

// Places in a panel 282 wide and 960 high, from its lower left corner.
constexpr double left = 24;
constexpr double panelWidth = 282;
constexpr double panelHeight = 960;
constexpr double textureSide = 216;
constexpr double textureBottom = 460;
constexpr double firstKey = 350;
constexpr double keyStep = 44;
constexpr double keySide = 20;
constexpr double fontSize = 17;
constexpr double lineSpacing = 1.5;

template<class... Values>
std::string formatted(const char* format, Values... values)
{
    char text[128];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

vtkSmartPointer<vtkActor> flatActor(vtkAlgorithm& shape)
{
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(shape.GetOutputPort());
    mapper->ScalarVisibilityOff();
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    return actor;
}

vtkSmartPointer<vtkPlaneSource> square(double x, double y, double side)
{
    auto plane = vtkSmartPointer<vtkPlaneSource>::New();
    plane->SetOrigin(x, y, 0);
    plane->SetPoint1(x + side, y, 0);
    plane->SetPoint2(x, y + side, 0);
    return plane;
}

} // namespace

Legend::Legend(int width, int height, vtkTexture& texture, bool withWalls, bool section)
    : width_(width), height_(height),
      unit_(std::min(width / panelWidth, height / panelHeight))
{
    paintBackground(*renderer_, colours::panel);
    vtkCamera* camera = renderer_->GetActiveCamera(); // one unit is one pixel
    camera->ParallelProjectionOn();
    camera->SetParallelScale(0.5 * height_);
    camera->SetFocalPoint(0.5 * width_, 0.5 * height_, 0);
    camera->SetPosition(0.5 * width_, 0.5 * height_, 10);
    camera->SetClippingRange(1, 20);

    time_ = addText("", left, 900, 30);
    names_ = addText("", left, 860, fontSize);
    names_->GetTextProperty()->SetVerticalJustificationToTop();
    names_->GetTextProperty()->SetLineSpacing(lineSpacing);
    values_ = addText("", panelWidth - left, 860, fontSize);
    values_->GetTextProperty()->SetVerticalJustificationToTop();
    values_->GetTextProperty()->SetLineSpacing(lineSpacing);
    values_->GetTextProperty()->SetJustificationToRight();
    addTexture(texture);
    addKeys(withWalls, section);
}

void Legend::addTexture(vtkTexture& texture)
{
    const auto plane = square(left * unit_, textureBottom * unit_, textureSide * unit_);
    const auto actor = flatActor(*plane);
    actor->SetTexture(&texture);
    renderer_->AddActor(actor);

    const double right = left + textureSide;
    addText("parameter p = (u, v)", left, textureBottom + textureSide + 12, fontSize);
    addText("0", left, textureBottom - 24, fontSize);
    addText("u", left + 0.5 * textureSide - 5, textureBottom - 24, fontSize);
    addText("1", right - 10, textureBottom - 24, fontSize);
    addText("0", right + 8, textureBottom, fontSize);
    addText("v", right + 8, textureBottom + 0.5 * textureSide - 6, fontSize);
    addText("1", right + 8, textureBottom + textureSide - 14, fontSize);
    addText("grid lines at 1/16", left, textureBottom - 50, 14);
}

void Legend::addKeys(bool withWalls, bool section)
{
    const double text = left + keySide + 12;
    double y = firstKey;
    addSquare(left, y, keySide, colours::attached);
    addText("attached now or before", text, y + 3, fontSize);
    y -= keyStep;
    addSquare(left, y, keySide, colours::entered);
    addText("entered now or before", text, y + 3, fontSize);
    y -= keyStep;
    addDisk(left + 0.5 * keySide, y + 0.5 * keySide, 0.35 * keySide, colours::detached);
    addText("detached: particles", text, y + 3, fontSize);
    if (section)
    {
        y -= keyStep;
        addSquare(left, y, keySide, colours::fluid);
        addText("fluid", text, y + 3, fontSize);
    }
    if (withWalls)
    {
        y -= keyStep;
        addSquare(left, y, keySide, section ? colours::edge : colours::wall);
        addText("wall", text, y + 3, fontSize);
    }
}

void Legend::addSquare(double x, double y, double side, const colours::Rgb& colour)
{
    const auto actor = flatActor(*square(x * unit_, y * unit_, side * unit_));
    paint(*actor->GetProperty(), colour);
    renderer_->AddActor(actor);
}

void Legend::addDisk(double x, double y, double radius, const colours::Rgb& colour)
{
    vtkNew<vtkRegularPolygonSource> disk;
    disk->SetNumberOfSides(40);
    disk->SetRadius(radius * unit_);
    disk->SetCenter(x * unit_, y * unit_, 0);
    const auto actor = flatActor(*disk);
    paint(*actor->GetProperty(), colour);
    renderer_->AddActor(actor);
}

vtkSmartPointer<vtkTextActor>
Legend::addText(const std::string& text, double x, double y, double fontSize)
{
    auto actor = vtkSmartPointer<vtkTextActor>::New();
    actor->SetInput(text.c_str());
    actor->GetPositionCoordinate()->SetCoordinateSystemToViewport();
    actor->SetPosition(std::round(x * unit_), std::round(y * unit_));
    actor->GetTextProperty()->SetFontFamilyToArial();
    actor->GetTextProperty()->SetFontSize(int(std::lround(fontSize * unit_)));
    paint(*actor->GetTextProperty(), colours::text);
    renderer_->AddViewProp(actor);
    return actor;
}

void Legend::show(const Frame& frame, const FrameNumbers& numbers)
{
    time_->SetInput(formatted("t = %.4g s", frame.time).c_str());
    std::string names = "interface", values = formatted("%06d", frame.index);
    const auto add = [&](const char* name, const std::string& value)
    {
        names += std::string("\n") + name;
        values += "\n" + value;
    };
    if (numbers.stableFraction)
    {
        add("stable area", formatted("%.2f %%", 100 * *numbers.stableFraction));
    }
    if (numbers.keptFraction)
    {
        add("kept of T", formatted("%.2f %%", 100 * *numbers.keptFraction));
    }
    if (numbers.coverage)
    {
        add("area with p", formatted("%.2f %%", 100 * *numbers.coverage));
    }
    if (numbers.epsilon)
    {
        add("epsilon", formatted("%.3g m", *numbers.epsilon));
    }
    if (numbers.particles)
    {
        add("particles", formatted("%.0f", *numbers.particles));
    }
    names_->SetInput(names.c_str());
    values_->SetInput(values.c_str());
}

} // namespace Foam::stability
