// SPDX-License-Identifier: GPL-3.0-or-later
// Part of interfaceStability, an extension of OpenFOAM.

#include "foam/functionObject/interfaceStability.H"

#include "addToRunTimeSelectionTable.H"
#include "foam/Failures.H"
#include "fvMesh.H"
#include "sigFpe.H"

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
    : fvMeshFunctionObject(name, runTime, dict)
{
    read(dict);
    if (!postProcess)
    {
        checkFields(dict);
    }
    if (!beginsLater(dict))
    {
        advance();
    }
}

bool interfaceStability::read(const dictionary& dict)
{
    stability::Controls controls;
    const auto parse = [&]
    { controls = stability::readControls(dict, stability::Shell::functionObject); };
    if (!wasRead_)
    {
        fvMeshFunctionObject::read(dict);
        parse();
        controls_ = controls;
        wasRead_ = true;
    }
    else
    {
        // A slip of the pen must not end a job that runs.
        const std::string failure = stability::failureOf(
            [&]
            {
                parse();
                fvMeshFunctionObject::read(dict);
            }
        );
        if (!failure.empty())
        {
            Warning << type() << ' ' << name() << ": " << failure.c_str() << nl
                    << "    The entries stay as they were." << endl;
            return true;
        }
        controls_.onError = controls.onError;
        Info << type() << ' ' << name()
             << ": entries were read again; onError, log and "
             << "the time controls apply now, the others at the next start." << endl;
    }
    everyWrite_ = dict.found("writeControl") || dict.found("outputControl");
    if (session_)
    {
        session_->report(log);
    }
    return true;
}

void interfaceStability::checkFields(const dictionary& dict) const
{
    // Without any field the solver has not made them yet.
    if (mesh_.names<volVectorField>().empty())
    {
        return;
    }
    const std::string failure = stability::failureOf(
        [&]
        {
            const stability::CaseFields fields(mesh_, controls_.alpha, controls_.U);
            const std::string missing = fields.missing();
            if (!missing.empty())
            {
                throw std::runtime_error(missing);
            }
            stability::FaceFlux flux(mesh_, controls_.phi, controls_.velocity);
            flux.choose(instantList());
        }
    );
    if (!failure.empty())
    {
        FatalIOErrorInFunction(dict) << failure.c_str() << exit(FatalIOError);
    }
}

bool interfaceStability::beginsLater(const dictionary& dict) const
{
    // As timeControl, which calls execute() from then on.
    scalar timeStart = -VGREAT;
    if (dict.readIfPresent("timeStart", timeStart))
    {
        timeStart = time_.userTimeToTime(timeStart);
    }
    return time_.value() < timeStart - 0.5 * time_.deltaTValue();
}

void interfaceStability::guarded(const std::function<void()>& work)
{
    if (disabled_ || !session_)
    {
        return;
    }
    // Trapped exceptions would end the solver; results are tested to be finite.
    const sigFpe::ignore untrapped;
    const std::string failure = stability::failureOf(work);
    if (failure.empty())
    {
        return;
    }
    session_.reset();
    report(failure);
}

void interfaceStability::report(const std::string& failure)
{
    ++nFailures_;
    disabled_ =
        controls_.onError == stability::OnError::stop || nFailures_ >= maxFailures;
    Warning << type() << ' ' << name() << ": " << failure.c_str() << nl
            << (disabled_ ? "    The analysis stops here; the solver goes on."
                          : "    The analysis starts afresh at the next step.")
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
    guarded(
        [&]
        {
            session_->advance();
            // The start is classified whatever time it is.
            if (starts)
            {
                session_->classify();
            }
        }
    );
}

void interfaceStability::begin()
{
    const sigFpe::ignore untrapped;
    const std::string failure = stability::failureOf(
        [&]
        {
            session_ =
                std::make_unique<stability::AnalysisSession>(mesh_, controls_, name());
            session_->report(log);
        }
    );
    if (!failure.empty())
    {
        report(failure);
    }
}

bool interfaceStability::execute()
{
    advance();
    return true;
}

bool interfaceStability::write()
{
    if (everyWrite_ || time_.writeTime() || postProcess)
    {
        guarded(
            [&]
            {
                session_->classify();
                nFailures_ = 0;
            }
        );
    }
    return true;
}

bool interfaceStability::end()
{
    guarded([&] { session_->complete(); });
    return true;
}

void interfaceStability::updateMesh(const mapPolyMesh&)
{
    if (session_)
    {
        session_->meshChanged();
    }
}

void interfaceStability::movePoints(const polyMesh&)
{
    if (session_)
    {
        session_->meshChanged();
    }
}

} // namespace functionObjects
} // namespace Foam
