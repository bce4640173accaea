// SPDX-License-Identifier: GPL-3.0-or-later

#include "Scene.H"

#include "Camera.H"
#include "Colours.H"
#include "Messages.H"
#include "Section.H"
#include "Surface.H"
#include "Surroundings.H"

#include "core/base/FileReplacement.H"

#include <vtkImageData.h>
#include <vtkImageShrink3D.h>
#include <vtkLight.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace Foam::stability
{

namespace
{

// Depth peeling excludes multisampling: drawn larger and averaged instead.
constexpr int oversampling = 2;
constexpr double lineWidth = 1.2;        // [pixels]
constexpr double broadLineWidth = 0.008; // [diagonals] of the interface of a section
constexpr double layer = 1e-3; // [diagonals] from one of its layers to the next
constexpr int nPeels = 12;     // each from the front and from the back

// The legend keeps its shape; it takes what it needs of a wide picture, not more.
int legendWidth(const std::array<int, 2>& size)
{
    return int(std::min(0.22 * size[0], 0.294 * size[1]));
}

// A file that cannot be read is told of when it is asked for.
void addBounds(vtkBoundingBox& box, const std::filesystem::path& file)
{
    try
    {
        const auto surface = readSurface(file);
        if (surface->GetNumberOfPoints() > 0)
        {
            box.AddBounds(surface->GetBounds());
        }
    }
    catch (const std::runtime_error&)
    {
        return;
    }
}

// Everything in the run, for a camera that does not depend on the time.
vtkBoundingBox boxOfResults(const ResultFiles& results)
{
    vtkBoundingBox box;
    for (const Frame& frame : results.frames())
    {
        addBounds(box, frame.interface);
        if (!frame.particles.empty())
        {
            addBounds(box, frame.particles);
        }
    }
    if (!box.IsValid() || !(box.GetDiagonalLength() > 0))
    {
        box.SetBounds(0, 1, 0, 1, 0, 1);
    }
    return box;
}

// A section is not seen from along its normal.
vtkVector3d upwards(
    const std::string& asked, const std::filesystem::path& caseFolder,
    const std::optional<vtkVector3d>& normal
)
{
    if (asked.empty())
    {
        const vtkVector3d up = upwardAxis(caseFolder);
        const bool along = normal && std::abs(up.Dot(*normal)) > 0.5;
        return !along                         ? up
               : std::abs((*normal)[2]) > 0.5 ? vtkVector3d(0, 1, 0)
                                              : vtkVector3d(0, 0, 1);
    }
    vtkVector3d up(0, 0, 0);
    up[asked.back() - 'x'] = asked[0] == '-' ? -1 : 1;
    return up;
}

// The normal of the section, if the results are of one.
std::optional<vtkVector3d> normalOf(const ResultFiles& results)
{
    try
    {
        return sectionNormal(*readSurface(results.frames().front().interface));
    }
    catch (const std::runtime_error&)
    {
        return std::nullopt; // the file is told of when it is asked for
    }
}

vtkBoundingBox flattenedBox(const vtkBoundingBox& box, const vtkVector3d& normal)
{
    double bounds[6];
    box.GetBounds(bounds);
    for (int i = 0; i < 3; ++i)
    {
        if (std::abs(normal[i]) > 0.5)
        {
            bounds[2 * i] = bounds[2 * i + 1] = 0;
        }
    }
    return vtkBoundingBox(bounds);
}

void addLight(vtkRenderer& renderer, double x, double y, double intensity)
{
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(x, y, 1);
    light->SetFocalPoint(0, 0, 0);
    light->SetIntensity(intensity);
    renderer.AddLight(light);
}

} // namespace

Scene::Scene(const Arguments& arguments, const ResultFiles& results)
    : arguments_(arguments), results_(results),
      boundary_(readCaseBoundary(results.caseFolder())),
      texture_(readTexture(results.texture())), normal_(normalOf(results))
{
    if (!boundary_.box.IsValid())
    {
        boundary_.box = boxOfResults(results);
    }
    placeRenderers();
    placeLights();
    if (normal_)
    {
        boundary_.box = flattenedBox(boundary_.box, *normal_);
        fluid_ = std::make_unique<CaseFluid>(results.caseFolder());
        showOutline();
    }
    else
    {
        showSurroundings();
    }
    lookAtIt();
}

void Scene::lookAtIt()
{
    const int width = arguments_.size[0] - legendWidth(arguments_.size);
    ViewDirection view;
    view.up = upwards(arguments_.up, results_.caseFolder(), normal_);
    if (normal_ && std::abs(view.up.Dot(*normal_)) > 0.5)
    {
        throw std::runtime_error(
            "The option -up " + arguments_.up
            + " is along the normal of the two-dimensional mesh, which is seen "
              "face-on: "
              "take another axis."
        );
    }
    view.right = rightAxis(view.up, normal_);
    view.azimuth = arguments_.azimuth.value_or(normal_ ? 0 : 30);
    view.elevation = arguments_.elevation.value_or(normal_ ? 0 : 22);
    view.zoom = arguments_.zoom;
    view.parallel = bool(normal_);
    aim(*renderer_->GetActiveCamera(), boundary_.box, view,
        double(width) / arguments_.size[1]);
}

Scene::~Scene() = default;

void Scene::placeRenderers()
{
    const int width = oversampling * arguments_.size[0];
    const int height = oversampling * arguments_.size[1];
    window_->SetOffScreenRendering(1);
    window_->SetSize(width, height);
    window_->SetMultiSamples(0); // else peeled pictures are black
    window_->SetAlphaBitPlanes(1);

    const int panelWidth = oversampling * legendWidth(arguments_.size);
    const double border = 1 - double(panelWidth) / width;
    renderer_->SetViewport(0, 0, border, 1);
    paintBackground(*renderer_, colours::background);
    renderer_->SetUseDepthPeeling(1);
    renderer_->SetMaximumNumberOfPeels(nPeels);
    renderer_->SetOcclusionRatio(0);
    window_->AddRenderer(renderer_);

    const auto& walls = normal_ ? boundary_.allWalls : boundary_.walls;
    legend_ = std::make_unique<Legend>(
        panelWidth, height, *texture_, walls->GetNumberOfCells() > 0, bool(normal_)
    );
    legend_->renderer().SetViewport(border, 0, 1, 1);
    window_->AddRenderer(&legend_->renderer());
}

void Scene::placeLights()
{
    renderer_->AutomaticLightCreationOff();
    addLight(*renderer_, -0.4, 0.6, 0.75);
    addLight(*renderer_, 0.9, 0.1, 0.4);
}

void Scene::showSurroundings()
{
    const double width = oversampling * lineWidth;
    renderer_->AddActor(boxActor(boundary_.box, width));
    if (boundary_.walls->GetNumberOfCells() > 0)
    {
        renderer_->AddActor(wallActor(*boundary_.walls));
        renderer_->AddActor(wallEdgeActor(*boundary_.walls, width));
    }
}

// Heights are those of the layers in front of each other, in diagonals.
void Scene::showOutline()
{
    const double width = oversampling * lineWidth;
    const double height = layer * boundary_.box.GetDiagonalLength();
    if (boundary_.outer->GetNumberOfCells() == 0)
    {
        renderer_->AddActor(boxActor(boundary_.box, width));
        return;
    }
    const auto show = [&](vtkPolyData& lines, double broad)
    { renderer_->AddActor(linesActor(*flattened(lines, *normal_, height), broad)); };
    show(*outlineOf(*boundary_.outer, *normal_), width);
    show(*sectionLines(*boundary_.allWalls, *normal_), 3 * width);
}

// Laid flat: the fluid at the height 0, then the outline, the interface, the particles.
void Scene::showSection(const Frame& frame, vtkPolyData& interface)
{
    const double diagonal = boundary_.box.GetDiagonalLength();
    const auto shades = fluid_->shades(frame.time, *normal_);
    if (shades->GetNumberOfPolys() > 0)
    {
        frameActors_.push_back(lightActor(*flattened(*shades, *normal_, 0)));
    }
    if (interface.GetNumberOfPolys() > 0)
    {
        const auto line = broadLine(
            interface, *normal_, broadLineWidth * diagonal, 2 * layer * diagonal
        );
        frameActors_.push_back(
            broadLineActor(*line, *texture_, arguments_.opacity.value_or(1))
        );
    }
}

void Scene::showFrame(const Frame& frame)
{
    for (const auto& actor : frameActors_)
    {
        renderer_->RemoveActor(actor);
    }
    frameActors_.clear();

    const auto surface = readSurface(frame.interface);
    if (normal_)
    {
        showSection(frame, *surface);
    }
    else if (surface->GetNumberOfPolys() > 0)
    {
        const double opacity = arguments_.opacity.value_or(0.85);
        frameActors_.push_back(surfaceActor(*surface, *texture_, opacity));
    }
    FrameNumbers numbers = results_.numbers(frame);
    if (!frame.particles.empty())
    {
        auto particles = readSurface(frame.particles);
        if (!numbers.particles)
        {
            numbers.particles = double(particles->GetNumberOfPoints());
        }
        if (particles->GetNumberOfPoints() > 0)
        {
            const double diagonal = boundary_.box.GetDiagonalLength();
            if (normal_)
            {
                particles = flattened(*particles, *normal_, 3 * layer * diagonal);
            }
            frameActors_.push_back(
                particleActor(*particles, arguments_.particleSize * diagonal)
            );
        }
    }
    for (const auto& actor : frameActors_)
    {
        renderer_->AddActor(actor);
    }
    legend_->show(frame, numbers);
}

void Scene::writePicture(const Frame& frame, const std::filesystem::path& picture)
{
    showFrame(frame);
    renderer_->ResetCameraClippingRange();
    window_->Render();

    vtkNew<vtkWindowToImageFilter> grab;
    grab->SetInput(window_);
    grab->SetInputBufferTypeToRGB();
    grab->ReadFrontBufferOff();
    grab->ShouldRerenderOff();
    vtkNew<vtkImageShrink3D> average;
    average->SetInputConnection(grab->GetOutputPort());
    average->SetShrinkFactors(oversampling, oversampling, 1);
    average->AveragingOn();
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(average->GetOutputPort());
    writer->WriteToMemoryOn();
    writer->Write();

    const std::string error = takeError();
    if (!error.empty() || !writer->GetResult())
    {
        throw std::runtime_error(
            "Cannot draw the picture of " + frame.interface.string() + ": " + error
        );
    }
    replaceFile(
        picture.string(), writer->GetResult()->GetPointer(0),
        writer->GetResult()->GetNumberOfValues()
    );
}

} // namespace Foam::stability
