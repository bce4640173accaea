// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/reconstruction/Reconstruction.H"
#include "core/base/Errors.H"
#include "core/flow/VolumeFractions.H"
#include "core/reconstruction/BonnellDual.H"
#include "core/reconstruction/GivenInterface.H"
#include "core/reconstruction/InterfaceOrder.H"
#include "core/reconstruction/InterfaceSmoothing.H"
#include "core/reconstruction/IsoAlpha.H"
#include "core/reconstruction/MarchingTets.H"
#include "core/reconstruction/PlicPolygons.H"

namespace Foam::stability
{

namespace
{

template<class Method>
std::unique_ptr<Reconstruction> make(const ReconstructionOptions& options)
{
    return std::make_unique<Method>(options);
}

// Throws BadInput where an option is given that the method does not have.
void require(
    bool possible, const std::string& option, const ReconstructionOptions& options
)
{
    if (!possible)
    {
        throw BadInput(
            option + " is not for the reconstruction " + options.method + "."
        );
    }
}

void checkOptions(
    const ReconstructionOptions& options, const ReconstructionMethod& method
)
{
    if (options.smooth < 0)
    {
        throw BadInput(
            "The number of smoothing steps (smooth) must not be negative, found "
            + std::to_string(options.smooth) + "."
        );
    }
    require(method.canSmooth || options.smooth == 0, "Smoothing (smooth)", options);
    require(
        method.canSharpen || options.sharpening == Sharpening::none, "Sharpening",
        options
    );
    require(
        method.canFitVolumes || options.volumeFit == VolumeFit::none,
        "Fitting volumes (volumeFit)", options
    );
}

} // namespace

const std::vector<ReconstructionMethod>& reconstructionMethods()
{
    // name, maker, sharesPoints, canSmooth, canSharpen, canFitVolumes, readsFiles,
    // epsilon, reach, reference. Droplets are looked at with six rings; to extract
    // alike, fewer would do.
    // clang-format off
    static const std::vector<ReconstructionMethod> methods{
        {"isoAlpha", make<IsoAlpha>, true, true, true, true, false, 0.5, 6, "bonnell"},
        {"bonnell", make<BonnellDual>, true, true, false, false, false, 1, 6, "isoAlpha"},
        {"plic", make<PlicPolygons>, false, false, false, false, false, 0.5, 6, "bonnell"},
        {"fromFiles", make<GivenInterface>, true, false, false, false, true, 0.5, 6, "bonnell"},
    };
    // clang-format on
    return methods;
}

std::vector<std::string> reconstructionNames()
{
    std::vector<std::string> names;
    for (const ReconstructionMethod& method : reconstructionMethods())
    {
        names.push_back(method.name);
    }
    return names;
}

const ReconstructionMethod& reconstructionMethod(const std::string& name)
{
    std::string known;
    for (const ReconstructionMethod& method : reconstructionMethods())
    {
        if (method.name == name)
        {
            return method;
        }
        known += (known.empty() ? "" : ", ") + method.name;
    }
    throw BadInput(
        "The reconstruction \"" + name + "\" is unknown; known are " + known + "."
    );
}

// The points of owned triangles depend on this many rings; where they are sharpened, on
// the fits in cells that are near by their extents, which look at so many rings around.
FetchReach reachOf(const ReconstructionOptions& options)
{
    constexpr label toSharpen = 3, toFit = 3; // rings more
    constexpr scalar ofFits = 3;              // cells
    constexpr label ofStencils = 5;           // rings
    FetchReach reach(
        reconstructionMethod(options.method).reach
        + (options.volumeFit == VolumeFit::none ? 0 : toFit)
        + 2 * options.smooth // each pair of steps looks twice at neighbours
    );
    if (options.sharpening != Sharpening::none)
    {
        reach.nRings += toSharpen;
        reach.cells = ofFits;
        reach.stencil = ofStencils;
    }
    return reach;
}

std::unique_ptr<Reconstruction> Reconstruction::New(const ReconstructionOptions& options
)
{
    const ReconstructionMethod& method = reconstructionMethod(options.method);
    checkOptions(options, method);
    return method.make(options);
}

ReconstructionResult Reconstruction::finish(
    MarchingTets& tets, const CellComplex& complex, const VolumeFractions& fractions,
    const ReconstructionOptions& options
)
{
    ReconstructionResult result;
    result.alphaVolume = fractions.volume;
    result.volume = tets.volume().value_or(fractions.volume);
    result.mesh = tets.takeMesh();
    orderByCells(result.mesh);
    if (options.smooth > 0)
    {
        result.volume.add(smoothInterface(result.mesh, complex, options.smooth));
    }
    return result;
}

} // namespace Foam::stability
