// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/reconstruction/Reconstruction.H"
#include "core/base/Errors.H"
#include "core/reconstruction/BonnellDual.H"
#include "core/reconstruction/GivenInterface.H"
#include "core/reconstruction/InterfaceOrder.H"
#include "core/reconstruction/InterfaceSmoothing.H"
#include "core/reconstruction/IsoAlpha.H"
#include "core/reconstruction/MarchingTets.H"
#include "core/reconstruction/PlicPolygons.H"

#include <algorithm>

namespace Foam::stability
{

const std::vector<std::string>& Reconstruction::names()
{
    static const std::vector<std::string> all{
        "isoAlpha", "bonnell", "plic", "fromFiles"};
    return all;
}

namespace
{

void checkOptions(const ReconstructionOptions& options)
{
    if (options.smooth < 0)
    {
        throw BadInput(
            "The number of smoothing steps (smooth) must not be negative, found "
            + std::to_string(options.smooth) + "."
        );
    }
    if (options.smooth > 0 && !Reconstruction::canSmooth(options.method))
    {
        throw BadInput(
            "Smoothing (smooth) is not for the reconstruction " + options.method + "."
        );
    }
    if (options.sharpening != Sharpening::none && options.method != "isoAlpha")
    {
        throw BadInput(
            "Sharpening is for the reconstruction isoAlpha, not " + options.method + "."
        );
    }
    if (options.volumeFit != VolumeFit::none && options.method != "isoAlpha")
    {
        throw BadInput(
            "Fitting volumes (volumeFit) is for the reconstruction isoAlpha, not "
            + options.method + "."
        );
    }
}

} // namespace

bool Reconstruction::canSmooth(const std::string& method)
{
    return method == "isoAlpha" || method == "bonnell";
}

std::unique_ptr<Reconstruction> Reconstruction::New(const ReconstructionOptions& options
)
{
    if (std::find(names().begin(), names().end(), options.method) == names().end())
    {
        std::string known;
        for (const std::string& name : names())
        {
            known += (known.empty() ? "" : ", ") + name;
        }
        throw BadInput(
            "The reconstruction \"" + options.method + "\" is unknown; known are "
            + known + "."
        );
    }
    checkOptions(options);
    if (options.method == "bonnell")
    {
        return std::make_unique<BonnellDual>(options);
    }
    if (options.method == "plic")
    {
        return std::make_unique<PlicPolygons>(options);
    }
    if (options.method == "fromFiles")
    {
        return std::make_unique<GivenInterface>();
    }
    return std::make_unique<IsoAlpha>(options);
}

ReconstructionResult Reconstruction::finish(
    MarchingTets& tets, const CellComplex& complex, scalar alphaVolume,
    const ReconstructionOptions& options
)
{
    ReconstructionResult result;
    result.alphaVolume = alphaVolume;
    result.volume = tets.volume();
    result.mesh = tets.takeMesh();
    orderByCells(result.mesh);
    if (options.smooth > 0)
    {
        result.volume += smoothInterface(result.mesh, complex, options.smooth);
    }
    return result;
}

} // namespace Foam::stability
