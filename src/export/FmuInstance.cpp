// SPDX-License-Identifier: Apache-2.0
#include "FmuInstance.h"

#include <cmath>

namespace qplc_export {

namespace {

QString name(FmuInstance::Phase phase)
{
    switch (phase) {
    case FmuInstance::Instantiated:
        return QStringLiteral("it is instantiated, and initialization has not begun");
    case FmuInstance::Initializing:
        return QStringLiteral("it is in the initialization mode");
    case FmuInstance::Stepping:
        return QStringLiteral("it is initialized");
    case FmuInstance::Terminated:
        return QStringLiteral("it is terminated");
    case FmuInstance::Failed:
        return QStringLiteral("it has failed");
    }
    return {};
}

QString number(double value)
{
    return QString::number(value, 'g', 12);
}

}  // namespace

std::unique_ptr<FmuInstance> FmuInstance::make(Standard standard, const char *instanceName, const char *token, Log log)
{
    std::unique_ptr<FmuInstance> instance(new FmuInstance(standard, std::move(log)));
    if (!instanceName || !*instanceName)
        return instance->fail(QStringLiteral("the instance has no name; give it one")), nullptr;
    QString error;
    if (!instance->m_node.make(&error))
        return instance->fail(error), nullptr;
    const QString own = tokenOf(instance->m_node, standard);
    const QString given = QString::fromUtf8(token ? token : "");
    if (given != own) {
        instance->fail(QStringLiteral("the identification '%1' is not that of this library, which is %2; use the "
                                      "modelDescription.xml that belongs to it")
                           .arg(given, own));
        return nullptr;
    }
    if (HeldPlant *plant = instance->m_node.plant())
        plant->setTeller([one = instance.get()](HeldPlant::News news, const QString &text) {
            one->tell(news == HeldPlant::News::Address ? Level::Notice : Level::Info, text);
        });
    instance->m_variables = variablesOf(instance->m_node, standard);
    instance->m_texts.resize(instance->m_variables.size());
    instance->m_isRefused.resize(instance->m_variables.size());
    if (!instance->runner().reset())
        return instance->fail(instance->runner().errorString()), nullptr;
    return instance;
}

void FmuInstance::tell(Level level, const QString &text) const
{
    if (level != Level::Info || m_isLogging)
        m_log(level, text.toUtf8().constData());
}

bool FmuInstance::fail(const QString &text) const
{
    tell(Level::Error, text);
    return false;
}

bool FmuInstance::allows(const char *function, int phases) const
{
    return (m_phase & phases) != 0
        || fail(QStringLiteral("%1 is not allowed now, because %2").arg(QLatin1String(function), name(m_phase)));
}

// ---- phases ----

bool FmuInstance::setStart(double start)
{
    if (!std::isfinite(start))
        return fail(QStringLiteral("the start time %1 is not a finite number").arg(number(start)));
    m_start = start;
    return true;
}

/// The inputs that the host has set are kept: the node has been reset already.
bool FmuInstance::enterInitialization()
{
    QString error;
    m_phase = m_node.open(&error) ? Initializing : Failed;
    return m_phase == Initializing || fail(error);
}

bool FmuInstance::exitInitialization()
{
    m_phase = runner().initialize() ? Stepping : Failed;
    return m_phase == Stepping || fail(m_node.failure());
}

double FmuInstance::time() const
{
    return m_start + double(runner().time().count()) * 1e-9;
}

/// Hosts add up their time, and so it drifts.
bool FmuInstance::isNow(double other) const
{
    return std::abs(other - time()) <= 0.01e-9 * double(runner().period().count()) + 1e-9 * std::abs(other);
}

FmuInstance::StepResult FmuInstance::doStep(double begin, double size, bool *wantsStop)
{
    const double period = double(runner().period().count()) * 1e-9;
    const double count = std::round(size / period);
    if (!isNow(begin))
        fail(QStringLiteral("a step at %1 s is not possible, because the node is at %2 s; steps follow each other "
                            "without gaps")
                 .arg(number(begin), number(time())));
    else if (!(count >= 1.0 && count <= 1e9) || std::abs(size - count * period) > 1e-6 * size + 1e-12 * std::abs(begin))
        fail(QStringLiteral("a step of %1 s is not possible; use %2 s, the period of the node, or a whole multiple of "
                            "it")
                 .arg(number(size), number(period)));
    else
        return runCycles(qint64(count), wantsStop);
    return StepResult::Failed;
}

FmuInstance::StepResult FmuInstance::runCycles(qint64 count, bool *wantsStop)
{
    bool isWarned = false;
    for (qint64 cycle = 0; cycle < count && !*wantsStop; ++cycle) {
        if (!runner().step()) {
            m_phase = Failed;
            fail(m_node.failure());
            return StepResult::Failed;
        }
        warnOfRefusedInputs();
        isWarned = warnOfPlant() || isWarned;
        *wantsStop = runner().wantsSafeStop();
    }
    const QString reason = m_node.plant() ? m_node.plant()->endReason() : QString();
    if (*wantsStop)
        tell(Level::Discard,
             reason.isEmpty() ? QStringLiteral("the node wants a safe stop in cycle %1").arg(runner().nextCycle() - 1)
                              : reason);
    return isWarned ? StepResult::Warned : StepResult::Complete;
}

bool FmuInstance::warnOfPlant()
{
    const QString warning = m_node.plant() ? m_node.plant()->warning() : QString();
    if (!warning.isEmpty())
        tell(Level::Warning, warning);
    return !warning.isEmpty();
}

/// The first one of a row.
void FmuInstance::warnOfRefusedInputs()
{
    for (std::size_t i = 0; i < m_variables.size() && m_variables[i].isInput; ++i) {
        const bool isRefused = !runner().quality(m_variables[i].signal).isGood();
        if (isRefused && !m_isRefused[i])
            tell(Level::Warning,
                 QStringLiteral("%1 is not finite or outside of its limits: the node reads the last good value (%2)")
                     .arg(m_variables[i].name, runner().quality(m_variables[i].signal).toString()));
        m_isRefused[i] = isRefused;
    }
}

void FmuInstance::terminate()
{
    runner().stop();
    m_phase = Terminated;
}

bool FmuInstance::reset()
{
    m_phase = Instantiated;
    m_start = 0.0;
    if (m_node.plant())
        m_node.plant()->close();
    std::fill(m_isRefused.begin(), m_isRefused.end(), false);
    if (runner().reset())
        return true;
    m_phase = Failed;
    return fail(runner().errorString());
}

// ---- variables ----

const FmuVariable *FmuInstance::find(const char *function, unsigned reference) const
{
    if (reference >= 1 && reference <= m_variables.size())
        return &m_variables[reference - 1];
    fail(QStringLiteral("%1: there is no variable with the value reference %2")
             .arg(QLatin1String(function))
             .arg(reference));
    return nullptr;
}

const FmuVariable *FmuInstance::find(const char *function, unsigned reference, FmuVariable::Kind kind) const
{
    const FmuVariable *variable = find(function, reference);
    if (!variable || variable->kind == kind)
        return variable;
    fail(QStringLiteral("%1: variable '%2' has the type %3")
             .arg(QLatin1String(function), variable->name, nameOf(variable->kind)));
    return nullptr;
}

bool FmuInstance::isSettable(const char *function, const FmuVariable &variable) const
{
    if (variable.isSetting && m_phase != Instantiated)
        return fail(QStringLiteral("%1: '%2' is a parameter; set it before the initialization begins")
                        .arg(QLatin1String(function), variable.name));
    return variable.isInput
        || fail(QStringLiteral("%1: '%2' is an output of the node; set inputs only")
                    .arg(QLatin1String(function), variable.name));
}

bool FmuInstance::setReal(const char *function, const FmuVariable &variable, double value)
{
    return runner().setReal(variable.signal, value, variable.element)
        || fail(QStringLiteral("%1: %2 does not fit '%3' of type %4")
                    .arg(QLatin1String(function), number(value), variable.name,
                         m_node.signal(variable.signal).type.name()));
}

bool FmuInstance::setInteger(const char *function, const FmuVariable &variable, qint64 value, int element)
{
    return runner().setInteger(variable.signal, value, variable.element + element)
        || fail(QStringLiteral("%1: %2 does not fit '%3' of type %4")
                    .arg(QLatin1String(function))
                    .arg(value)
                    .arg(variable.name, m_node.signal(variable.signal).type.name()));
}

bool FmuInstance::setText(const char *function, const FmuVariable &variable, const char *text)
{
    if (text && runner().setValue(variable.signal, QPlcValue(text)))
        return true;
    return fail(QStringLiteral("%1: the text does not fit '%2' of type %3: it is null, too long, or not UTF-8")
                    .arg(QLatin1String(function), variable.name, m_node.signal(variable.signal).type.name()));
}

const char *FmuInstance::text(const FmuVariable &variable)
{
    std::string &text = m_texts[std::size_t(&variable - m_variables.data())];
    text = runner().value(variable.signal).toString().toStdString();
    return text.c_str();
}

}  // namespace qplc_export
