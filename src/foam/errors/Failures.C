// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "foam/errors/Failures.H"

#include <new>

namespace Foam::stability
{

ThrowingErrors::ThrowingErrors()
    : error_(FatalError.throwExceptions()), ioError_(FatalIOError.throwExceptions())
{
}

ThrowingErrors::~ThrowingErrors()
{
    FatalError.throwExceptions(error_);
    FatalIOError.throwExceptions(ioError_);
}

std::string describe(const std::exception& failure)
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

std::string failureOf(const std::function<void()>& work)
{
    const ThrowingErrors throwing;
    try
    {
        work();
    }
    catch (const std::exception& failure)
    {
        const std::string text = describe(failure);
        return text.empty() ? "An error without a message." : text;
    }
    return std::string();
}

void exitOnFailure(const std::function<void()>& work)
{
    const std::string failure = failureOf(work);
    if (!failure.empty())
    {
        FatalErrorInFunction << failure.c_str() << exit(FatalError);
    }
}

} // namespace Foam::stability
