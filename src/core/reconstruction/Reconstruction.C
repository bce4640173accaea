// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "core/reconstruction/Reconstruction.H"
#include "core/Errors.H"
#include "core/reconstruction/BonnellDual.H"
#include "core/reconstruction/InterfaceSmoothing.H"
#include "core/reconstruction/IsoAlpha.H"
#include "core/reconstruction/MarchingTets.H"

namespace Foam::stability
{

const std::vector<std::string>& Reconstruction::names()
{
    static const std::vector<std::string> all{"isoAlpha", "bonnell"};
    return all;
}

std::unique_ptr<Reconstruction> Reconstruction::New(const ReconstructionOptions& options
)
{
    if (options.smooth < 0)
    {
        throw BadInput(
            "The number of smoothing steps (smooth) must not be negative, found "
            + std::to_string(options.smooth) + "."
        );
    }
    if (options.method == "isoAlpha")
    {
        return std::make_unique<IsoAlpha>(options);
    }
    if (options.method == "bonnell")
    {
        if (options.sharpening != Sharpening::none)
        {
            throw BadInput("Sharpening is for the reconstruction isoAlpha, not bonnell."
            );
        }
        return std::make_unique<BonnellDual>(options);
    }
    std::string known;
    for (const std::string& name : names())
    {
        known += (known.empty() ? "" : ", ") + name;
    }
    throw BadInput(
        "The reconstruction \"" + options.method + "\" is unknown; known are " + known
        + "."
    );
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
    if (options.smooth > 0)
    {
        result.volume += smoothInterface(result.mesh, complex, options.smooth);
    }
    return result;
}

} // namespace Foam::stability
