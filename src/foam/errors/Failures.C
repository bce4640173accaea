// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/errors/Failures.H"

#include "core/base/Errors.H"

#include "dictionary.H"

#include <cstdlib>

namespace Foam::stability
{

ThrowingErrors::ThrowingErrors()
    : error_(FatalError.throwExceptions()), ioError_(FatalIOError.throwExceptions()),
      newHandler_(std::set_new_handler(nullptr))
{
}

ThrowingErrors::~ThrowingErrors()
{
    FatalError.throwExceptions(error_);
    FatalIOError.throwExceptions(ioError_);
    std::set_new_handler(newHandler_);
}

void failOn(const dictionary& dict, const std::string& sentence)
{
    FatalIOError("", "", 0, dict) << sentence.c_str() << exit(FatalIOError);
    std::abort(); // not reached: exit() ends the program or throws
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
        return describe(failure);
    }
    return std::string();
}

void exitOnFailure(const std::function<void()>& work)
{
    const std::string failure = failureOf(work);
    if (!failure.empty())
    {
        FatalError("", "", 0) << failure.c_str() << exit(FatalError);
    }
}

} // namespace Foam::stability
