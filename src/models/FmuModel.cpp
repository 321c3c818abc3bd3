// SPDX-License-Identifier: Apache-2.0
#include "FmuModel.h"

#include "FmuArchive.h"
#include "QPlcValue.h"
#include "signals/ConfigurationFile.h"
#include "signals/MessageText.h"

#include <QtCore/QFileInfo>
#include <QtCore/QSysInfo>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace qplc {

namespace {

const QString descriptionName = QStringLiteral("modelDescription.xml");

/// Names of this computer in FMI 2.0 and FMI 3.0; exporters use both in both.
QStringList ownPlatforms()
{
    const QString processor = QSysInfo::buildCpuArchitecture();
    if (processor == QLatin1String("x86_64"))
        return {QStringLiteral("x86_64-linux"), QStringLiteral("linux64")};
    if (processor == QLatin1String("arm64"))
        return {QStringLiteral("aarch64-linux"), QStringLiteral("linuxaarch64"), QStringLiteral("linux-aarch64")};
    return {processor + QStringLiteral("-linux")};
}

std::string messageOf(const QString &text)
{
    return text.toStdString();
}

bool integerFromText(const FmuVariable &variable, const QString &text, qint64 *value)
{
    for (const QPair<qint64, QString> &item : variable.items) {
        if (item.second == text) {
            *value = item.first;
            return true;
        }
    }
    bool isNumber = false;
    if (variable.kind == FmuVariable::Boolean) {
        isNumber = true;
        *value = text == QLatin1String("true") || text == QLatin1String("1") ? 1
            : text == QLatin1String("false") || text == QLatin1String("0")   ? 0
                                                                             : (isNumber = false, 0);
    } else if (variable.kind == FmuVariable::UInt64) {
        *value = qint64(text.toULongLong(&isNumber));
    } else {
        *value = text.toLongLong(&isNumber);
    }
    return isNumber;
}

/// \param bits  of the type of \a kind
template<typename T>
bool isInRange(qint64 value)
{
    return value >= qint64(std::numeric_limits<T>::min()) && value <= qint64(std::numeric_limits<T>::max());
}

bool fitsKind(FmuVariable::Kind kind, qint64 value)
{
    switch (kind) {
    case FmuVariable::Int8:
        return isInRange<qint8>(value);
    case FmuVariable::UInt8:
        return isInRange<quint8>(value);
    case FmuVariable::Int16:
        return isInRange<qint16>(value);
    case FmuVariable::UInt16:
        return isInRange<quint16>(value);
    case FmuVariable::Int32:
        return isInRange<qint32>(value);
    case FmuVariable::UInt32:
        return isInRange<quint32>(value);
    default:
        return true;
    }
}

}  // namespace

// ---- opening ----

std::unique_ptr<FmuModel> FmuModel::open(const QString &fileName, QString *error)
{
    std::unique_ptr<FmuModel> model(new FmuModel(fileName));
    if (!model->read(error)) {
        *error = QStringLiteral("%1: %2").arg(fileName, *error);
        return nullptr;
    }
    return model;
}

bool FmuModel::read(QString *error)
{
    FmuArchive archive;
    QByteArray xml;
    if (!archive.open(m_fileName, error) || !archive.read(descriptionName, FmuDescription::LargestText, &xml, error))
        return false;
    QPlcParseError place;
    m_description = FmuDescription::fromXml(xml, &place);
    if (!m_description.isValid()) {
        *error = place.toString();
        return false;
    }
    if (m_description.needsExecutionTool) {
        *error = QStringLiteral("the FMU needs the tool that has made it (%1) at run time; export it again as a "
                                "stand-alone FMU")
                     .arg(quoted(m_description.generationTool));
        return false;
    }
    m_platforms = archive.platforms();
    for (const QString &platform : ownPlatforms()) {
        const QString library = QStringLiteral("binaries/%1/%2.so").arg(platform, m_description.modelIdentifier);
        if (m_platform.isEmpty() && archive.contains(library))
            m_platform = platform;
    }
    if (m_platform.isEmpty())
        return true;  // what it says can be shown all the same
    m_folder = FmuFolder::make(error);
    return m_folder && archive.unpack(QStringLiteral("binaries/%1/").arg(m_platform), m_folder->path(), error)
        && archive.unpack(QStringLiteral("resources/"), m_folder->path(), error);
}

FmuModel::~FmuModel()
{
    if (m_state == Dead && m_instance)
        FmuInstance::abandon(std::move(m_instance));
    else
        end();
}

bool FmuModel::load(QString *error)
{
    if (m_state != NotLoaded)
        return true;
    if (m_platform.isEmpty()) {
        *error = QStringLiteral("%1: the FMU has no library binaries/%2/%3.so for this computer; it has libraries for "
                                "%4: export it for Linux on this processor")
                     .arg(m_fileName, ownPlatforms().first(), m_description.modelIdentifier,
                          m_platforms.isEmpty() ? QStringLiteral("no platform") : firstOf(m_platforms));
        return false;
    }
    const QString library
        = QStringLiteral("%1/binaries/%2/%3.so").arg(m_folder->path(), m_platform, m_description.modelIdentifier);
    m_instance = FmuInstance::load(m_description, library, m_log, error);
    if (!m_instance) {
        *error = QStringLiteral("%1: %2").arg(m_fileName, *error);
        return false;
    }
    m_inputs = FmuExchange(m_description.version, m_description.hasEventMode);
    m_outputs = FmuExchange(m_description.version, false);
    m_state = Loaded;
    return true;
}

// ---- start values ----

bool FmuModel::readStart(const FmuDescription &description, const QString &name, const QString &text, Start *start,
                         QString *error)
{
    const FmuVariable *variable = description.find(name);
    start->variable = variable;
    if (!variable) {
        *error = QStringLiteral("the FMU has no variable %1%2")
                     .arg(quoted(name), didYouMean(description.closeNames(name)));
        return false;
    }
    if (!variable->hasStart() || (!variable->isNumber() && variable->kind != FmuVariable::String)) {
        *error = QStringLiteral("%1 (%2) has no start value that can be set; parameters and inputs have one")
                     .arg(quoted(name), variable->causalityText());
        return false;
    }
    start->text = text;
    if (variable->kind == FmuVariable::String)
        return true;
    const bool isReal = variable->kind == FmuVariable::Float32 || variable->kind == FmuVariable::Float64;
    const QStringList parts
        = QString(text).replace(QLatin1Char(','), QLatin1Char(' ')).simplified().split(QLatin1Char(' '));
    for (const QString &part : parts) {
        double number = 0.0;
        qint64 integer = 0;
        bool isGood = false;
        if (isReal)
            isGood = finiteNumberFromText(part, &number);
        else
            isGood = integerFromText(*variable, part, &integer) && fitsKind(variable->kind, integer);
        if (!isGood) {
            *error = QStringLiteral("%1 is not a value of %2 (%3)")
                         .arg(quoted(part), quoted(name), variable->typeText(description.version));
            return false;
        }
        start->numbers.append(number);
        start->integers.append(integer);
    }
    if (parts.size() == 1) {
        start->numbers.fill(start->numbers.first(), variable->count);
        start->integers.fill(start->integers.first(), variable->count);
    } else if (parts.size() != variable->count) {
        *error = QStringLiteral("%1 has %2 elements, and here are %3 values; write one for each, or one for all")
                     .arg(quoted(name))
                     .arg(variable->count)
                     .arg(parts.size());
        return false;
    }
    return true;
}

void FmuModel::writeStarts()
{
    for (const Start &start : qAsConst(m_settings.starts)) {
        const FmuVariable &variable = *start.variable;
        if (variable.kind == FmuVariable::String) {
            expect(m_instance->setText(variable.reference, start.text), "its start values");
            continue;
        }
        FmuExchange exchange(m_description.version, false);
        char *bytes = exchange.at(exchange.add(variable));
        const QPlcSignalType::Scalar scalar = variable.scalar(m_description.version);
        for (int i = 0; i < variable.count; ++i) {
            const QPlcSignalType type(scalar);
            const QPlcValue value = type.isReal()  ? QPlcValue(start.numbers.at(i)).convertedTo(type)
                : scalar == QPlcSignalType::UInt64 ? QPlcValue(quint64(start.integers.at(i)))
                                                   : QPlcValue(start.integers.at(i)).convertedTo(type);
            value.toBytes(bytes + i * type.size());
        }
        expect(exchange.set(*m_instance, true), "its start values");
    }
}

// ---- phases ----

void FmuModel::reset()
{
    if (m_state == Dead)
        throw std::runtime_error(
            "the FMU has reported a fatal error, after which it cannot be used; start this program "
            "again");
    Q_ASSERT_X(m_state != NotLoaded, "FmuModel::reset", "load() comes first");
    m_log->forgetComplaint();
    m_steps = 0;
    m_isOver = false;
    m_isRefused = false;
    if (!m_instance->exists()) {
        if (!m_instance->instantiate(m_folder->path() + QStringLiteral("/resources"), m_settings.logs)) {
            const QString complaint = m_log->lastComplaint();
            throw std::runtime_error(messageOf(
                QStringLiteral("the FMU refuses to be instantiated%1; either its library and its "
                               "modelDescription.xml do not belong together (%2 %3), or it needs something that is "
                               "not there, such as a licence")
                    .arg(complaint.isEmpty() ? QString() : QStringLiteral(": %1").arg(quoted(complaint)),
                         m_description.version == 2 ? QStringLiteral("guid") : QStringLiteral("instantiationToken"),
                         quoted(m_description.token))));
        }
    } else {
        expect(m_instance->reset(), "the reset");
    }
    m_state = Loaded;
    writeStarts();
    m_start = m_time = m_description.startTime.value_or(0.0);
    const FmuInstance::Experiment experiment{m_start, m_settings.stopTime,
                                             m_settings.tolerance ? m_settings.tolerance : m_description.tolerance};
    expect(m_instance->enterInitializationMode(experiment), "the begin of the initialization");
    m_state = Initializing;
}

void FmuModel::initialize()
{
    expect(m_inputs.set(*m_instance, true), "its initial inputs");
    expect(m_instance->exitInitializationMode(), "the end of the initialization");
    if (m_instance->usesEventMode())
        handleEvents(true);
    m_state = Stepping;
}

void FmuModel::readOutputs()
{
    expect(m_outputs.get(*m_instance), "its outputs");
}

void FmuModel::writeInputs()
{
    if (m_isOver)
        return;
    const bool isEvent = m_instance->usesEventMode() && m_inputs.hasDiscreteChange();
    if (isEvent)
        expect(m_instance->enterEventMode(), "an event");
    expect(m_inputs.set(*m_instance, isEvent || !m_instance->usesEventMode()), "its inputs");
    if (isEvent)
        handleEvents(true);
}

/// A step of whole nanoseconds gives the nearest number to the exact time: 3 * 0.1 s is 0.3 s.
double FmuModel::multipleOf(double step, qint64 count)
{
    const double nanoseconds = step * 1e9;
    const double whole = std::round(nanoseconds);
    const bool isWhole = std::abs(nanoseconds - whole) <= 1e-15 * nanoseconds && whole * double(count) < 9e15;
    return isWhole ? whole * double(count) / 1e9 : step * double(count);
}

void FmuModel::setStep(double step)
{
    const double inner = m_description.fixedInternalStep.value_or(0.0);
    const double ratio = inner > 0.0 ? step / inner : 1.0;
    if (std::abs(ratio - std::round(ratio)) > 1e-6 || ratio < 0.5)
        throw std::runtime_error(messageOf(
            QStringLiteral(
                "the FMU computes in steps of %1 s, of which a step of %2 s is no multiple; choose a multiple")
                .arg(inner)
                .arg(step)));
    m_step = step;
}

void FmuModel::doStep()
{
    if (m_isOver)
        return;
    const FmuInstance::Step result = m_instance->doStep(m_time, m_step);
    if (result.status == fmi::Discard || result.isOver) {
        m_isOver = true;
        m_isRefused = !result.isOver;
        const double done = result.isOver ? result.lastTime - m_time : 0.0;
        if (done > 0.0 && done <= m_step + 1e-9)
            m_time = result.lastTime;
        return;
    }
    expect(result.status, "a step");
    if (result.isEarly)
        fail(fmi::Error,
             QStringLiteral("a step, which it has ended early at %1 s although that is not allowed")
                 .arg(result.lastTime));
    m_time = m_start + multipleOf(m_step, ++m_steps);
    if (result.needsEvent && m_instance->usesEventMode())
        handleEvents(false);
}

/// FMI 3: lets the FMU change its state at events, until it has no more to change.
void FmuModel::handleEvents(bool isInEventMode)
{
    constexpr int most = 1000;
    if (!isInEventMode)
        expect(m_instance->enterEventMode(), "an event");
    bool needsUpdate = true;
    for (int i = 0; needsUpdate && !m_isOver; ++i) {
        if (i == most)
            fail(fmi::Error, QStringLiteral("an event, which does not end after %1 iterations").arg(most));
        bool isOver = false;
        expect(m_instance->updateDiscreteStates(&needsUpdate, &isOver), "an event");
        m_isOver = m_isOver || isOver;
    }
    if (!m_isOver)
        expect(m_instance->enterStepMode(), "the end of an event");
}

void FmuModel::end()
{
    if (m_state == Stepping && m_instance->terminate() == fmi::Fatal)
        m_state = Dead;
    else if (m_state == Stepping)
        m_state = Ended;
}

QString FmuModel::overText() const
{
    return m_isRefused ? QStringLiteral("the FMU has discarded the step at %1 s").arg(time())
                       : QStringLiteral("the FMU has ended the simulation at %1 s").arg(time());
}

void FmuModel::expect(int status, const char *doing)
{
    if (status > fmi::Warning)
        fail(status, QString::fromLatin1(doing));
}

void FmuModel::fail(int status, const QString &doing)
{
    m_state = status == fmi::Fatal ? Dead : Failed;
    const QString complaint = m_log->lastComplaint();
    const char *name = FmuInstance::lastCall();
    throw std::runtime_error(
        messageOf(QStringLiteral("the FMU reports %1 (%2) at %3 s, in %4%5")
                      .arg(status == fmi::Fatal         ? QStringLiteral("a fatal error")
                               : status == fmi::Discard ? QStringLiteral("that it discards the call")
                                                        : QStringLiteral("an error"),
                           QString::fromLatin1(name ? name : "?"))
                      .arg(time())
                      .arg(doing, complaint.isEmpty() ? QString() : QStringLiteral(": %1").arg(quoted(complaint)))));
}

}  // namespace qplc
