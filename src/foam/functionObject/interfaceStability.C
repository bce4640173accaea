// SPDX-License-Identifier: GPL-3.0-or-later

#include "foam/functionObject/interfaceStability.H"

#include "addToRunTimeSelectionTable.H"
#include "core/comparison/StabilityTables.H"
#include "foam/errors/Failures.H"
#include "foam/functionObject/StartChecks.H"
#include "fvMesh.H"

#include <stdexcept>
#include <string>

namespace Foam
{
namespace functionObjects
{

defineTypeNameAndDebug(interfaceStability, 0);
addToRunTimeSelectionTable(functionObject, interfaceStability, dictionary);

namespace
{

// `onError resume` gives up after so many failures without a result in between.
constexpr label maxFailures = 3;

} // namespace

interfaceStability::interfaceStability(
    const word& name, const Time& runTime, const dictionary& dict
)
    : fvMeshFunctionObject(name, stability::meshOf(runTime, dict), dict),
      writeFile(mesh_, name, typeName)
{
    const stability::ScopedTimer busy(cost_.seconds());
    // A condition of runTimeControl holds where its value does not exist.
    publish(stability::Statistics());
    for (const char* fraction : {"stableFraction", "keptFraction", "coverage"})
    {
        setResult(word(fraction), scalar(1));
    }
    if (!stability::hasStepped(time_))
    {
        readFirst(dict);
    }
    else
    {
        tryToRead(dict);
    }
    if (ready() && stability::beginsNow(time_, dict))
    {
        advance();
    }
}

interfaceStability::~interfaceStability()
{
    // end() is not called after timeEnd.
    finish();
}

void interfaceStability::readFirst(const dictionary& dict)
{
    fvMeshFunctionObject::read(dict);
    stability::checkRegion(mesh_, dict);
    controls_ = stability::readControls(dict, stability::Caller::functionObject);
    if (!postProcess)
    {
        stability::checkFields(mesh_, controls_.fields, dict);
    }
    everyWrite_ = dict.found("writeControl") || dict.found("outputControl");
    writeToFile_ = controls_.writeToFile && Pstream::master();
    writePrecision_ = controls_.writePrecision;
    schedule_ =
        std::make_unique<stability::ClassifySchedule>(time_, controls_.classify);
}

// A mistake of a function object that is added to a running solver ends no job.
void interfaceStability::tryToRead(const dictionary& dict)
{
    const std::string failure = stability::failureOf([&] { readFirst(dict); });
    if (!failure.empty())
    {
        Warning << type() << ' ' << name() << ": " << failure.c_str() << nl
                << "    The solver goes on without analysis until the entry is right."
                << endl;
    }
}

void interfaceStability::readAgain(const dictionary& dict)
{
    stability::Controls controls;
    // A slip of the pen must not end a job that runs.
    const std::string failure = stability::failureOf(
        [&]
        {
            controls = stability::readControls(dict, stability::Caller::functionObject);
            fvMeshFunctionObject::read(dict);
        }
    );
    if (!failure.empty())
    {
        Warning << type() << ' ' << name() << ": " << failure.c_str() << nl
                << "    The entries stay as they were." << endl;
        return;
    }
    controls_.onError = controls.onError;
    everyWrite_ = dict.found("writeControl") || dict.found("outputControl");
    Info << type() << ' ' << name() << ": entries were read again; onError, log and "
         << "the time controls apply now, the others at the next start." << endl;
    if (session_)
    {
        session_->report(log);
    }
}

// Later readings find a job that runs.
bool interfaceStability::read(const dictionary& dict)
{
    if (ready())
    {
        readAgain(dict);
    }
    else
    {
        tryToRead(dict);
    }
    return true;
}

stability::FieldSource interfaceStability::source()
{
    return postProcess ? stability::FieldSource::disk : stability::FieldSource::solver;
}

void interfaceStability::guarded(const std::function<void()>& work)
{
    if (disabled_ || !session_)
    {
        return;
    }
    const std::string failure = stability::failureOf(work);
    if (failure.empty())
    {
        return;
    }
    // All ranks fail together; the one at fault was the first to stop.
    const label first = returnReduce(label(session_->phase()), minOp<label>());
    const std::string phase = stability::phaseNames()[std::size_t(first)];
    session_.reset();
    report(phase + ": " + failure);
}

void interfaceStability::report(const std::string& failure)
{
    ++nFailures_;
    disabled_ =
        controls_.onError == stability::OnError::stop || nFailures_ >= maxFailures;
    Warning << type() << ' ' << name() << ": in step " << time_.timeIndex() << ", time "
            << time_.timeName() << " s: " << failure.c_str() << nl
            << (!disabled_    ? "    The analysis starts afresh at the next step."
                : postProcess ? "    The analysis stops here."
                              : "    The analysis stops here; the solver goes on.")
            << endl;
}

void interfaceStability::advance()
{
    if (disabled_)
    {
        return;
    }
    const bool starts = !session_;
    if (starts)
    {
        begin();
    }
    guarded([&] { session_->advance(); });
    if (starts)
    {
        // The start is classified and written whatever time it is.
        classify();
        guarded([&] { session_->writeFiles(); });
    }
}

void interfaceStability::begin()
{
    const std::string failure = stability::failureOf(
        [&]
        {
            session_ = std::make_unique<stability::AnalysisSession>(
                mesh_, controls_, baseFileDir() / name(), source()
            );
            session_->report(log);
        }
    );
    if (!failure.empty())
    {
        report(failure);
    }
}

void interfaceStability::classify()
{
    guarded(
        [&]
        {
            session_->classify();
            publish(session_->statistics());
            nFailures_ = 0;
        }
    );
}

// The results are published so that other function objects can read them, above all
// runTimeControl.
void interfaceStability::publish(const stability::Statistics& statistics)
{
    for (const auto& column : stability::stabilityTable().columns)
    {
        if (column.name != "Time")
        {
            setResult(word(column.name), column.value(statistics));
        }
    }
    setResult(word("detachedArea"), statistics.detachedArea());
}

bool interfaceStability::execute()
{
    const stability::ScopedTimer busy(cost_.seconds());
    if (!ready())
    {
        return true;
    }
    bool due = schedule_->due();
    advance();
    if (controls_.classify.displacement > 0)
    {
        guarded([&]
                { due |= session_->displacement() >= controls_.classify.displacement; }
        );
    }
    if (due && !postProcess)
    {
        classify();
    }
    return true;
}

bool interfaceStability::write()
{
    const stability::ScopedTimer busy(cost_.seconds());
    if (!ready())
    {
        return true;
    }
    const bool asWritten = schedule_->asWritten() && (everyWrite_ || time_.writeTime());
    if (asWritten || postProcess)
    {
        classify();
    }
    guarded([&] { session_->writeFiles(); });
    return true;
}

bool interfaceStability::end()
{
    finish();
    if (postProcess && ready())
    {
        const label n = session_ ? session_->nClassified() : 0;
        std::string failure;
        if (disabled_ || (!session_ && nFailures_ > 0))
        {
            failure = "the analysis broke off; a warning above says why.";
        }
        else if (n < 2)
        {
            failure = "times with all fields among those selected: " + std::to_string(n)
                      + "; the analysis compares consecutive times and needs at least "
                        "two.";
        }
        stability::exitOnFailure(
            [&]
            {
                if (!failure.empty())
                {
                    throw std::runtime_error(name() + ": " + failure);
                }
            }
        );
    }
    return true;
}

void interfaceStability::finish()
{
    if (finished_ || !ready())
    {
        return;
    }
    finished_ = true;
    guarded([&] { session_->complete(); });
    if (log)
    {
        Info << type() << ' ' << name() << ": " << cost_.text().c_str() << nl << endl;
    }
}

bool interfaceStability::adjustTimeStep()
{
    if (ready())
    {
        schedule_->adjustTimeStep(const_cast<Time&>(time_));
    }
    return true;
}

void interfaceStability::updateMesh(const mapPolyMesh&)
{
    if (session_)
    {
        session_->meshChanged(true);
    }
}

void interfaceStability::movePoints(const polyMesh&)
{
    if (session_)
    {
        session_->meshChanged(false);
    }
}

} // namespace functionObjects
} // namespace Foam
