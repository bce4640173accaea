// SPDX-License-Identifier: GPL-3.0-or-later

// makeResults LIBRARY FOLDER
//   Writes a result folder of known content through the writer in LIBRARY: a sphere
//   with longitude and latitude as p, a cap attached, and a cloud of particles. Traps
//   floating point exceptions as OpenFOAM does.

#include "vtk/VtpWriter.H"

#include "core/base/Version.H"
#include "core/results/ParameterTexture.H"

#include <cfenv>
#include <cmath>
#include <dlfcn.h>
#include <fstream>
#include <iostream>
#include <memory>

using namespace Foam;
using namespace Foam::stability;

namespace
{

constexpr int nAround = 96;
constexpr int nHigh = 48;
const point centre(0.35, 0.5, 0.55);
constexpr scalar radius = 0.22;
constexpr scalar capLatitude = 0.8; // from here on attached; 1 is the pole

ResultSurface sphere(scalar time, const point& shift)
{
    ResultSurface result;
    result.time = time;
    PointArray texture{"TCoords", 2, false, {}};
    PointArray stability{"stability", 1, true, {}};
    PointArray vertex{"vertex", 1, true, {}};
    const label nRing = nAround + 1; // split along the seam
    result.points.setSize(nRing * (nHigh + 1));
    for (int j = 0; j <= nHigh; ++j)
    {
        for (int i = 0; i <= nAround; ++i)
        {
            const scalar u = scalar(i) / nAround, v = scalar(j) / nHigh;
            const scalar a = 2 * M_PI * u, b = M_PI * (v - 0.5);
            const vector x(
                std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b)
            );
            result.points[nRing * j + i] = centre + shift + radius * x;
            const bool attached = v > capLatitude;
            const vector2D p = attached ? Swatches::attached()
                                        : vector2D(0.04 + 0.92 * u, 0.06 + 0.92 * v);
            texture.values.insert(texture.values.end(), {p.x(), p.y()});
            stability.values.push_back(attached);
            vertex.values.push_back(nRing * j + i % nAround);
        }
    }
    DynamicList<triFace> triangles;
    for (label j = 0; j < nHigh; ++j)
    {
        // No triangle between the cap and the rest: it would have to be split.
        if (scalar(j) / nHigh <= capLatitude && scalar(j + 1) / nHigh > capLatitude)
        {
            continue;
        }
        for (label i = 0; i < nAround; ++i)
        {
            const label a = nRing * j + i, b = a + nRing;
            triangles.append(triFace(a, a + 1, b + 1));
            triangles.append(triFace(a, b + 1, b));
        }
    }
    result.triangles = triangles;
    result.arrays = {texture, stability, vertex};
    return result;
}

// A dense cloud, behind which nothing shows; and far away one that left.
ResultSurface particles(scalar time, bool any)
{
    ResultSurface result;
    result.time = time;
    PointArray state{"state", 1, true, {}};
    DynamicList<point> points;
    for (int i = 0; i < 1000 && any; ++i)
    {
        points.append(
            point(0.8, 0.4, 0.7)
            + 0.06
                  * vector(
                      std::sin(12.9898 * i), std::sin(78.233 * i), std::sin(37.719 * i)
                  )
        );
        state.values.push_back(0);
    }
    if (any)
    {
        points.append(point(0.95, 0.5, 0.1));
        state.values.push_back(1);
    }
    result.points.transfer(points);
    result.arrays = {state};
    return result;
}

void writeSeries(const std::string& folder, const std::string& family)
{
    std::ofstream(folder + "/" + family + ".vtp.series")
        << "{\"file-series-version\": \"1.0\", \"files\": [\n"
        << "{\"name\": \"" << family << "_000000.vtp\", \"time\": 0},\n"
        << "{\"name\": \"" << family << "_000001.vtp\", \"time\": 0.02},\n"
        << "{\"name\": \"" << family << "_000002.vtp\", \"time\": 0.04}]}\n";
}

} // namespace

int main(int argc, char* argv[])
{
    void* library = argc == 3 ? dlopen(argv[1], RTLD_NOW) : nullptr;
    void* symbol = library ? dlsym(library, "interfaceStabilityNewVtpWriter") : nullptr;
    if (!symbol)
    {
        std::cerr << "makeResults: " << (argc == 3 ? dlerror() : "two arguments")
                  << '\n';
        return 1;
    }
    const std::unique_ptr<ResultWriter> writer(
        reinterpret_cast<ResultWriter* (*)()>(symbol)()
    );
    const std::string folder = argv[2];
    const int traps = FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW;
    feenableexcept(traps);
    try
    {
        writer->writeTexture(folder + "/texture.png", 1024);
        writer->writeVtp(folder + "/interface_000000.vtp", sphere(0, Zero));
        writer->writeVtp(
            folder + "/interface_000001.vtp", sphere(0.02, vector(0.2, 0, -0.1))
        );
        writer->writeVtp(
            folder + "/interface_000002.vtp", ResultSurface{0.04, {}, {}, {}, {}}
        );
        for (int i = 0; i < 3; ++i)
        {
            writer->writeVtp(
                folder + "/particles_00000" + std::to_string(i) + ".vtp",
                particles(0.02 * i, i > 0)
            );
        }
    }
    catch (const std::exception& error)
    {
        std::cerr << error.what() << '\n';
        return 1;
    }
    if (fegetexcept() != traps)
    {
        std::cerr << "the writer changed which floating point exceptions trap\n";
        return 1;
    }
    writeSeries(folder, "interface");
    writeSeries(folder, "particles");
    std::ofstream(folder + "/stability.dat")
        << "# " << generator() << "\n"
        << "# Stability of the interface\n"
        << "# Time\tarea\tstableFraction\tparticles\tepsilon\n"
        << "0\t0.6\t0.97\t0\t0.0156\n"
        << "0.02\t0.6\t0.875\t1001\t0.0156\n"
        << "0.04\t0\t1\t1001\t0.0156\n";
    return 0;
}
