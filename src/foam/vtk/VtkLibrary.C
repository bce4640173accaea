// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/vtk/VtkLibrary.H"

#include "OSspecific.H"
#include "fileName.H"

#include <stdexcept>

namespace Foam::stability
{

void* vtkEntryPoint(const char* name)
{
    const fileName library("libinterfaceStabilityVtk.so");
    std::string cause;
    void* handle = dlOpen(library, cause);
    void* symbol = handle ? dlSymFound(handle, name) : nullptr;
    if (!symbol)
    {
        throw std::runtime_error(
            "Cannot open " + library + ", which reads surfaces and writes the results ("
            + (handle ? "it lacks its entry point" : cause) + "): run Allwmake."
        );
    }
    return symbol;
}

} // namespace Foam::stability
