// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/entries/Methods.H"

#include "foam/entries/EntryReaders.H"
#include "foam/entries/ReconstructionControls.H"

namespace Foam::stability
{

std::vector<Method> readMethods(const dictionary& dict)
{
    if (!dict.found("methods", keyType::LITERAL))
    {
        return {{word::null, readControls(dict, Caller::utility)}};
    }
    std::vector<Method> methods;
    for (const auto& [name, entries] : readList(dict, "methods"))
    {
        for (const Method& other : methods)
        {
            if (other.name == name)
            {
                refuse(
                    dict, "methods",
                    "a list in which each name is new; " + name + " is twice"
                );
            }
        }
        checkKeys(entries, inMethods);
        // Entries that belong together are given together.
        dictionary outer(dict);
        outer.remove("methods");
        if (entries.found("reconstruction"))
        {
            outer.remove("sharpening");
            outer.remove("volumeFit");
        }
        const dictionary merged(overlaid(outer, entries));
        methods.push_back({name, readControls(merged, Caller::utility)});
    }
    if (methods.size() < 2)
    {
        refuse(
            dict, "methods", allowedText(entryRow("methods", EntryType::list).value)
        );
    }
    return methods;
}

} // namespace Foam::stability
