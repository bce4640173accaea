// SPDX-License-Identifier: GPL-3.0-or-later

#include "Messages.H"

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <algorithm>

namespace Foam::stability
{

namespace
{

std::string& firstError()
{
    static std::string text;
    return text;
}

class KeptMessages : public vtkOutputWindow
{
public:
    static KeptMessages* New();
    vtkTypeMacro(KeptMessages, vtkOutputWindow);

    void DisplayText(const char*) override {}
    void DisplayWarningText(const char*) override {}
    void DisplayGenericWarningText(const char*) override {}
    void DisplayDebugText(const char*) override {}
    void DisplayErrorText(const char* text) override
    {
        if (firstError().empty())
        {
            firstError() = text;
        }
    }
};

vtkStandardNewMacro(KeptMessages);

} // namespace

void keepMessages()
{
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF); // would say all twice
    vtkNew<KeptMessages> messages;
    vtkOutputWindow::SetInstance(messages);
}

std::string takeError()
{
    std::string text;
    std::swap(text, firstError());
    // "ERROR: In file, line 1\nvtkClass (0x1234): what happened\n\n"
    const auto start = text.find("): ");
    text = start == std::string::npos ? text : text.substr(start + 3);
    const auto end = text.find_last_not_of("\n ");
    text = end == std::string::npos ? std::string() : text.substr(0, end + 1);
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

} // namespace Foam::stability
