// SPDX-License-Identifier: Apache-2.0
#include "QPlcSimulinkNode.h"

#include "QPlcNodeApplication.h"
#include "signals/DurationText.h"
#include "signals/IniParser.h"
#include "signals/MessageText.h"
#include "signals/ValueText.h"

#include <QtCore/QSet>

#include <cstdio>
#include <stdexcept>

namespace {

constexpr qint64 largestParameterFile = 16 * 1024 * 1024;  // [byte]
const QString tableOption = QStringLiteral("table");
const QString parametersOption = QStringLiteral("parameters");

/// \return false when \a text is not a list of numbers
bool readNumbers(const QString &text, QVector<double> *numbers)
{
    QString separated = text;
    const QStringList words
        = separated.replace(QLatin1Char(','), QLatin1Char(' ')).simplified().split(QLatin1Char(' '));
    for (const QString &word : words) {
        double number = 0.0;
        bool tooLarge = false;
        if (!qplc::realFromText(word, &number, &tooLarge) || tooLarge)
            return false;
        numbers->append(number);
    }
    return true;
}

}  // namespace

QPlcSimulinkNode::QPlcSimulinkNode(const QString &name, std::chrono::nanoseconds sampleTime)
    : QPlcCompactSlaveNode(name)
    , m_sampleTime(sampleTime)
{
}

QPlcSimulinkNode::~QPlcSimulinkNode() = default;

void QPlcSimulinkNode::addSignal(const char *name, QPlcSignalType type, bool isBool, const char *description,
                                 const char *values)
{
    m_signals.append({QString::fromUtf8(name), isBool && !type.isArray() ? QStringLiteral("Bool") : type.name(),
                      QString::fromUtf8(description), QString::fromUtf8(values)});
}

void QPlcSimulinkNode::addParameter(const char *name, Parameter parameter)
{
    parameter.name = QString::fromUtf8(name);
    m_parameters.append(parameter);
}

QString QPlcSimulinkNode::table() const
{
    QString text;
    QSet<QString> names;
    for (const Signal &signal : m_signals) {
        if (names.contains(signal.name))
            continue;  // one that is read and written
        names.insert(signal.name);
        text += QStringLiteral("%1[%2]\ntype = %3\n").arg(text.isEmpty() ? "" : "\n", signal.name, signal.type);
        if (!signal.description.isEmpty())
            text += QStringLiteral("description = %1\n").arg(qplc::IniParser::valueText(signal.description));
        if (!signal.values.isEmpty())
            text += QStringLiteral("values = %1\n").arg(signal.values);
    }
    return text;
}

bool QPlcSimulinkNode::readParameters(const QString &fileName, QString *error)
{
    QByteArray text;
    QVector<QPlcParseError> errors;
    if (!qplc::IniParser::readFile(fileName, QStringLiteral("parameters"), largestParameterFile, &text, &errors)) {
        *error = QPlcParseError::toString(errors);
        return false;
    }
    QVector<Parameter> parameters = m_parameters;
    QStringList names;
    for (const Parameter &parameter : qAsConst(parameters))
        names << parameter.name;
    qplc::IniParser ini(text);
    bool isMine = false;
    for (qplc::IniItem item = ini.next(); item.kind != qplc::IniItem::End; item = ini.next()) {
        QString message = item.error;
        if (item.kind == qplc::IniItem::Section) {
            isMine = item.name == parametersOption;
        } else if (isMine && item.kind == qplc::IniItem::Entry && message.isEmpty()) {
            const int index = names.indexOf(item.name);
            message = index < 0 ? QStringLiteral("the model has no parameter '%1'%2")
                                      .arg(item.name, qplc::didYouMean(qplc::closeNames(item.name, names)))
                                : valueMistake(item.value, &parameters[index]);
        }
        if (!message.isEmpty())
            errors.append({fileName, item.line, item.column, message});
    }
    *error = QPlcParseError::toString(errors);
    if (errors.isEmpty())
        m_parameters = parameters;
    return errors.isEmpty();
}

/// Gives \a parameter the values of \a text. \return what is wrong with them; empty: nothing
QString QPlcSimulinkNode::valueMistake(const QString &text, Parameter *parameter)
{
    QVector<double> values;
    if (!readNumbers(text, &values))
        return QStringLiteral("'%1' of parameter '%2' is not a list of numbers; write them as in 1.5, -2, 3e-4")
            .arg(text, parameter->name);
    if (std::size_t(values.size()) != parameter->count)
        return QStringLiteral("parameter '%1' has %2 numbers in the model and %3 here")
            .arg(parameter->name)
            .arg(parameter->count)
            .arg(values.size());
    for (double value : qAsConst(values)) {
        if (!parameter->holds(value))
            return QStringLiteral("the type of parameter '%1' cannot hold %2")
                .arg(parameter->name, qplc::realText(value));
    }
    parameter->values = values;
    return {};
}

void QPlcSimulinkNode::setParameters()
{
    for (const Parameter &parameter : qAsConst(m_parameters)) {
        for (int i = 0; i < parameter.values.size(); ++i)
            parameter.store(parameter.variable, std::size_t(i), parameter.values.at(i));
    }
}

void QPlcSimulinkNode::refusePeriod(const QPlcCycle &cycle) const
{
    throw std::runtime_error(QStringLiteral("the sample time of the model is %1, and the period of the master is %2; "
                                            "set the period of the master to %1")
                                 .arg(qplc::durationText(m_sampleTime), qplc::durationText(cycle.period()))
                                 .toStdString());
}

void QPlcSimulinkNode::end(const char *errorStatus)
{
    requestSafeStop();
    throw std::runtime_error(errorStatus ? std::string("the model reports: ") + errorStatus
                                         : std::string("the model asks for the end of the simulation"));
}

int QPlcSimulinkNode::run(int argc, char **argv, Maker make)
{
    QPlcNodeApplication application(argc, argv);
    application.setDescription(QStringLiteral("A node generated from a Simulink model."));
    application.addOption(QCommandLineOption(
        tableOption, QStringLiteral("Prints the part of a signal table that has the signals of the node, and ends.")));
    application.addOption(QCommandLineOption(
        parametersOption, QStringLiteral("INI file whose section [parameters] sets tunable parameters of the model."),
        QStringLiteral("FILE")));
    if (!application.parseNodeOptions())
        return application.exitCode();
    const std::unique_ptr<QPlcSimulinkNode> node = make();
    if (application.isSet(tableOption)) {
        std::fputs(qPrintable(node->table()), stdout);
        return QPlcCoreApplication::Success;
    }
    QString error;
    if (application.isSet(parametersOption) && !node->readParameters(application.value(parametersOption), &error))
        return application.usageError(error);
    return application.run(*node);
}
