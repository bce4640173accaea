// SPDX-License-Identifier: GPL-3.0-or-later

#include "core/base/Errors.H"

#include "error.H"

#include <new>

namespace Foam::stability
{

namespace
{

std::string textOf(const std::exception& failure)
{
    if (const auto* io = dynamic_cast<const IOerror*>(&failure))
    {
        std::string text = io->message() + " (file " + io->ioFileName();
        if (io->ioStartLineNumber() >= 0)
        {
            text += ", line " + std::to_string(io->ioStartLineNumber());
        }
        return text + ")";
    }
    if (const auto* error = dynamic_cast<const Foam::error*>(&failure))
    {
        return error->message();
    }
    if (dynamic_cast<const std::bad_alloc*>(&failure))
    {
        return "There is not enough memory.";
    }
    return failure.what();
}

} // namespace

std::string describe(const std::exception& failure)
{
    const std::string text = textOf(failure);
    return text.empty() ? "An error without a message." : text;
}

} // namespace Foam::stability
