// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/errors/IncludeLimit.H"

#include <fcntl.h>
#include <unistd.h>

namespace Foam::stability
{

namespace
{

constexpr rlim_t mostIncludes = 200;

} // namespace

IncludeLimit::IncludeLimit()
{
    const int next = ::open("/dev/null", O_RDONLY);
    if (next < 0 || ::getrlimit(RLIMIT_NOFILE, &before_) != 0)
    {
        return;
    }
    ::close(next);
    const rlimit few{rlim_t(next) + mostIncludes, before_.rlim_max};
    lowered_ = few.rlim_cur < before_.rlim_cur && ::setrlimit(RLIMIT_NOFILE, &few) == 0;
}

IncludeLimit::~IncludeLimit()
{
    if (lowered_)
    {
        ::setrlimit(RLIMIT_NOFILE, &before_);
    }
}

} // namespace Foam::stability
