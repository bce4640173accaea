// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/errors/Failures.H"

#include "core/base/Errors.H"

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
        FatalErrorInFunction << failure.c_str() << exit(FatalError);
    }
}

} // namespace Foam::stability
