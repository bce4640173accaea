// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/results/ResultSet.H"

#include "core/base/Errors.H"
#include "core/base/FileOperations.H"
#include "core/base/FileReplacement.H"
#include "core/base/Version.H"
#include "core/comparison/StabilityTables.H"
#include "foam/results/Timings.H"
#include "OSspecific.H"
#include "fileNameList.H"

#include <algorithm>
#include <fstream>
#include <regex>

namespace Foam::stability
{

namespace
{

const std::string listName(".files");
const std::string lastLine("# complete");

std::string headOfList()
{
    return "# " + generator()
           + "\n# The files of a run. A later one moves and removes "
             "these only.\n";
}

struct FileList
{
    std::vector<std::string> names;
    bool complete = false;
};

bool isListed(const fileName& folder)
{
    return isThere(folder / listName);
}

// Names of files and folders of the set lie in its folder itself: a list that was
// damaged leads nowhere else.
bool isResultName(const std::string& name)
{
    return !name.empty() && name[0] != '#' && name[0] != '.'
           && name.find('/') >= name.size() - 1;
}

// A last line that was cut off names a file that was not written any more.
FileList readList(const fileName& folder)
{
    FileList list;
    std::ifstream file(folder / listName);
    if (!file && isListed(folder))
    {
        throw std::runtime_error("Cannot read the file " + folder / listName + ".");
    }
    for (std::string line; std::getline(file, line) && !file.eof();)
    {
        list.complete = list.complete || line == lastLine;
        if (isResultName(line))
        {
            list.names.push_back(line);
        }
    }
    return list;
}

bool isFolderName(const std::string& name)
{
    return name.back() == '/';
}

// The files of these names that are in the folder, with what a killed run left of them.
// Lists of files come first: at no moment do they name files that are gone.
std::vector<std::string>
filesOf(const fileName& folder, const std::vector<std::string>& names)
{
    static const std::regex piece("[0-9]+\\.vtp(\\.tmp)?"), list(".*\\.series");
    std::vector<std::string> files;
    for (const std::string& name : names)
    {
        if (!isFolderName(name))
        {
            files.insert(files.end(), {name, name + temporaryEnding});
        }
        else if (isFolder(folder / name))
        {
            for (const fileName& file : readDir(folder / name, fileName::FILE, false))
            {
                if (std::regex_match(file, piece))
                {
                    files.push_back(name + file);
                }
            }
        }
    }
    const auto isGone = [&](const std::string& name)
    { return !isThere(folder / name); };
    files.erase(std::remove_if(files.begin(), files.end(), isGone), files.end());
    std::stable_partition(
        files.begin(), files.end(),
        [](const std::string& name) { return std::regex_match(name, list); }
    );
    return files;
}

void removeEmptyFolders(const fileName& folder, const std::vector<std::string>& names)
{
    for (const std::string& name : names)
    {
        if (isFolderName(name))
        {
            removeEmptyFolder(folder / name.substr(0, name.size() - 1));
        }
    }
}

// Versions before 0.10 kept no list: their files are told by their names, in a folder
// with a table of ours.
std::vector<std::string> namesWithoutList(const fileName& folder)
{
    if (!isOwnTable(folder / stabilityTable().file))
    {
        return {};
    }
    std::vector<std::string> names{
        stabilityTable().file, survivalTable().file, dropletTable().file,
        timingTable().file, "texture.png"};
    static const std::regex file(
        "(interface|timeSurface|particles)(_[0-9]+\\.p?vtp|\\.p?vtp\\.series)"
    );
    for (const fileName& name : readDir(folder, fileName::FILE, false))
    {
        if (std::regex_match(name, file))
        {
            names.push_back(name);
            if (name.ext() == "pvtp")
            {
                names.push_back(name.lessExt() + '/');
            }
        }
    }
    return names;
}

// Writes the list that is lacking, and returns whether there is something to be listed.
bool listUnlisted(const fileName& folder, bool complete)
{
    const std::vector<std::string> names(namesWithoutList(folder));
    if (!names.empty())
    {
        std::string text = headOfList();
        for (const std::string& name : names)
        {
            text += name + '\n';
        }
        replaceFile(folder / listName, complete ? text + lastLine + '\n' : text);
    }
    return !names.empty();
}

void removeSet(const fileName& folder)
{
    const std::vector<std::string> names(readList(folder).names);
    for (const std::string& name : filesOf(folder, names))
    {
        removeFile(folder / name);
    }
    removeEmptyFolders(folder, names);
    removeFile(folder / listName);
}

} // namespace

bool isOwnTable(const fileName& file)
{
    std::string firstLine;
    std::ifstream table(file);
    std::getline(table, firstLine);
    return firstLine.rfind("# interfaceStability", 0) == 0;
}

void refuseInTheWay(const fileName& file)
{
    throw BadInput(
        "The file " + file
        + " is in the way of results, and interfaceStability did not write it: move it "
          "away."
    );
}

ResultSet::ResultSet(const fileName& folder)
    : folder_(folder), aside_(folder / "previous")
{
}

void ResultSet::begin() const
{
    makeFolders(folder_);
    if (!isListed(folder_) && !isListed(aside_))
    {
        const bool brokeOff = listUnlisted(aside_, true);
        listUnlisted(folder_, !brokeOff);
    }
    if (isListed(aside_) && readList(folder_).complete)
    {
        removeSet(aside_); // a run was killed at its end
    }
    if (isListed(folder_) && isListed(aside_))
    {
        removeSet(folder_); // a run broke off
    }
    if (isListed(folder_))
    {
        putAside();
    }
    if (isListed(aside_))
    {
        finishPuttingAside();
    }
    appendToFile(folder_ / listName, headOfList());
}

// The files get second names, and then the list decides that these are theirs. At no
// moment does a set lie in two folders, where the file system knows second names.
void ResultSet::putAside() const
{
    const std::vector<std::string> files(filesOf(folder_, readList(folder_).names));
    for (const std::string& name : files)
    {
        if (isThere(aside_ / name) && !isSameFile(folder_ / name, aside_ / name))
        {
            refuseInTheWay(aside_ / name);
        }
    }
    makeFolders(aside_);
    for (const std::string& name : files)
    {
        makeFolders(fileName(aside_ / name).path());
        linkFile(folder_ / name, aside_ / name);
    }
    moveFile(folder_ / listName, aside_ / listName);
}

// A run may have been killed before; none has written anything new since.
void ResultSet::finishPuttingAside() const
{
    const std::vector<std::string> names(readList(aside_).names);
    for (const std::string& name : filesOf(folder_, names))
    {
        if (!isThere(aside_ / name))
        {
            makeFolders(fileName(aside_ / name).path());
            moveFile(folder_ / name, aside_ / name);
        }
        else if (isSameFile(folder_ / name, aside_ / name))
        {
            removeFile(folder_ / name);
        }
    }
    removeEmptyFolders(folder_, names);
}

void ResultSet::add(const std::string& name) const
{
    const std::vector<std::string> files(filesOf(folder_, {name}));
    if (!files.empty())
    {
        refuseInTheWay(folder_ / files.front());
    }
    appendToFile(folder_ / listName, name + '\n');
}

void ResultSet::complete() const
{
    appendToFile(folder_ / listName, lastLine + '\n');
    if (isListed(aside_))
    {
        removeSet(aside_);
        removeEmptyFolder(aside_); // it stays if something of the user's is in it
    }
}

} // namespace Foam::stability
