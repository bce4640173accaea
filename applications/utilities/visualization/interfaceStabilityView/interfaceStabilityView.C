// SPDX-License-Identifier: GPL-3.0-or-later

// Pictures of what interfaceStability found; see -help.

#include "Arguments.H"
#include "Display.H"
#include "Messages.H"
#include "MethodsPlot.H"
#include "ResultFiles.H"
#include "Scene.H"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using namespace Foam::stability;
namespace fs = std::filesystem;

fs::path outputFolder(const Arguments& arguments, const ResultFiles& results)
{
    const fs::path folder = arguments.output.empty() ? results.path() / "pictures"
                                                     : fs::path(arguments.output);
    std::error_code error;
    fs::create_directories(folder, error);
    if (error || !fs::is_directory(folder, error))
    {
        throw std::runtime_error(
            "Cannot make the folder " + folder.string() + " for the pictures"
            + (error ? ": " + error.message() : "") + "."
        );
    }
    return folder;
}

void writePictures(const Arguments& arguments)
{
    if (!arguments.methods.empty())
    {
        const Display display;
        const fs::path picture = plotMethods(arguments.methods, arguments.size);
        std::cout << "picture 1 of 1: " << picture.string() << std::endl;
        return;
    }
    // Whatever can fail early fails before an X server is started.
    const std::vector<ResultFiles> runs = selectedResults(arguments);
    std::size_t count = 0;
    for (const ResultFiles& results : runs)
    {
        outputFolder(arguments, results);
        count += results.selected().size();
    }
    const Display display;

    keepMessages();
    std::size_t done = 0;
    for (const ResultFiles& results : runs)
    {
        const fs::path folder = outputFolder(arguments, results);
        // In one folder, pictures of several runs are told apart by where these began.
        const std::string prefix = runs.size() > 1 && !arguments.output.empty()
                                       ? results.path().filename().string() + "_"
                                       : "";
        Scene scene(arguments, results);
        for (const Frame& frame : results.selected())
        {
            char name[32];
            std::snprintf(name, sizeof name, "view_%06d.png", frame.index);
            const fs::path picture = folder / (prefix + name);
            scene.writePicture(frame, picture);
            std::cout << "picture " << ++done << " of " << count << ": "
                      << picture.string() << std::endl;
        }
    }
}

} // namespace

int main(int argc, char* argv[])
{
    try
    {
        const Arguments arguments = parseArguments(argc, argv);
        if (arguments.help)
        {
            std::cout << helpText();
            return 0;
        }
        if (!arguments.batch)
        {
            throw std::runtime_error("Only -batch is supported for now; see -help.");
        }
        writePictures(arguments);
        return 0;
    }
    catch (const std::exception& error)
    {
        std::cerr << "interfaceStabilityView: " << error.what() << '\n';
        return 1;
    }
}
