// SPDX-License-Identifier: Apache-2.0
#include "SignalRules.h"

#include "IniParser.h"
#include "MessageText.h"
#include "ValueOrder.h"

#include <cmath>

namespace qplc {

namespace {

constexpr int longestName = 63;
constexpr int longestNodeName = 64;

QString perSecond()
{
    return QStringLiteral(" per second");
}

using Complaints = QVector<Complaint>;

bool isLetter(QChar character)
{
    return (character >= QLatin1Char('a') && character <= QLatin1Char('z'))
        || (character >= QLatin1Char('A') && character <= QLatin1Char('Z')) || character == QLatin1Char('_');
}

bool isNameCharacter(QChar character)
{
    return isLetter(character) || (character >= QLatin1Char('0') && character <= QLatin1Char('9'))
        || character == QLatin1Char('.');
}

void checkName(const QString &name, Complaints *complaints)
{
    bool isName = !name.isEmpty() && isLetter(name.at(0));
    for (const QChar character : name)
        isName = isName && isNameCharacter(character);
    if (name.isEmpty())
        complaints->append({SignalKey::Name, QStringLiteral("the signal has no name; write it as [name]")});
    else if (!isName)
        complaints->append(
            {SignalKey::Name,
             QStringLiteral("%1 is not a valid signal name; use a letter or '_', then letters a-z A-Z, digits, "
                            "'_' or '.'")
                 .arg(quoted(name))});
    else if (name.size() > longestName)
        complaints->append({SignalKey::Name,
                            QStringLiteral("the signal name %1 has %2 characters; shorten it to at most %3")
                                .arg(quoted(name))
                                .arg(name.size())
                                .arg(longestName)});
}

enum class LineBreaks : quint8 { Allowed, Refused };

void checkText(SignalKey key, const QString &text, LineBreaks lineBreaks, Complaints *complaints)
{
    const auto isRefused = [lineBreaks](QChar character) {
        const ushort code = character.unicode();
        const bool isSpace = code == '\n' || code == '\r' || code == '\t';
        return isSpace ? lineBreaks == LineBreaks::Refused : code < 0x20 || code == 0x7F;
    };
    for (const QChar character : text) {
        if (isRefused(character)) {
            complaints->append({key,
                                QStringLiteral("control character 0x%1 in %2; remove it")
                                    .arg(int(character.unicode()), 2, 16, QLatin1Char('0'))
                                    .arg(quoted(text))});
            return;
        }
    }
    if (!text.isValidUtf16())
        complaints->append({key, QStringLiteral("%1 has half a surrogate pair; remove it").arg(quoted(text))});
}

void checkLimit(const QPlcSignalDefinition &signal, SignalKey key, const QPlcValue &limit, Complaints *complaints)
{
    if (!limit.isValid())
        return;
    if (!signal.type.isNumeric())
        complaints->append({key,
                            QStringLiteral("%1 cannot be limited by %2; remove the limit")
                                .arg(signal.type.name(), quoted(limit.toString()))});
    else if (limit.type() != elementType(signal.type))
        complaints->append({key,
                            QStringLiteral("the limit %1 is %2; give one %3")
                                .arg(limit.toString(), limit.type().name(), elementType(signal.type).name())});
    else if (std::isnan(limit.toReal()))
        complaints->append({key, QStringLiteral("nan is not a limit; give a number, or remove the limit")});
}

// \pre the limits are in order
void checkRange(const QPlcSignalDefinition &signal, SignalKey key, const QPlcValue &value, Complaints *complaints)
{
    if (!signal.isInRange(value))
        complaints->append({key,
                            QStringLiteral("the %1 value %2 is outside of min and max; give '%1 =' a value of %3")
                                .arg(signalKeyNames().at(int(key)), quoted(value.toString()), signal.rangeText())});
}

void checkValues(const QPlcSignalDefinition &signal, Complaints *complaints)
{
    const int before = complaints->size();
    checkLimit(signal, SignalKey::Minimum, signal.minimum, complaints);
    checkLimit(signal, SignalKey::Maximum, signal.maximum, complaints);
    if (complaints->size() > before)
        return;
    if (signal.minimum.isValid() && signal.maximum.isValid() && isLess(signal.maximum, 0, signal.minimum, 0)) {
        complaints->append({SignalKey::Maximum,
                            QStringLiteral("min %1 is greater than max %2; swap them")
                                .arg(signal.minimum.toString(), signal.maximum.toString())});
        return;
    }
    if (signal.type.isString()) {
        checkText(SignalKey::Initial, signal.initial.toString(), LineBreaks::Allowed, complaints);
        checkText(SignalKey::Safe, signal.safe.toString(), LineBreaks::Allowed, complaints);
    }
    if (signal.nanAllowed && !signal.type.isReal())
        complaints->append(
            {SignalKey::Nan, QStringLiteral("%1 cannot be NaN; remove 'nan ='").arg(signal.type.name())});
    checkRange(signal, SignalKey::Initial, signal.initial, complaints);
    if (!signal.safe.isFinite())
        complaints->append(
            {SignalKey::Safe,
             QStringLiteral("the safe value %1 is not finite; give a number").arg(quoted(signal.safe.toString()))});
    else
        checkRange(signal, SignalKey::Safe, signal.safe, complaints);
}

void checkType(SignalKey key, const QPlcValue &value, QPlcSignalType type, Complaints *complaints)
{
    if (value.isValid() && value.type() != type)
        complaints->append({key,
                            QStringLiteral("%1 is a %2; give a value of the type %3")
                                .arg(quoted(value.toString()), value.type().name(), type.name())});
}

void checkNames(const QPlcSignalDefinition &signal, Complaints *complaints)
{
    if (signal.valueNames.isEmpty())
        return;
    checkText(SignalKey::Values, signal.valueNames.toText(), LineBreaks::Refused, complaints);
    if (!signal.type.isInteger()) {
        complaints->append({SignalKey::Values,
                            QStringLiteral("values of %1 have no names; take an integer type, or remove 'values ='")
                                .arg(signal.type.name())});
        return;
    }
    const QPlcSignalType element = elementType(signal.type);
    for (const QPlcValueNames::Entry &entry : signal.valueNames) {
        const QPlcValue value = QPlcValue::fromString(element, QString::number(entry.value));
        if (value.isValid() && signal.isInRange(value))
            continue;
        const QString reason = value.isValid() ? QStringLiteral("is outside of min and max")
                                               : QStringLiteral("does not fit into ") + element.name();
        complaints->append(
            {SignalKey::Values,
             QStringLiteral("the value %1 (%2) %3; remove its name").arg(entry.value).arg(quoted(entry.name), reason)});
    }
}

void checkWriters(const QPlcSignalDefinition &signal, Complaints *complaints)
{
    for (int i = 0; i < signal.writers.size(); ++i) {
        const QString &name = signal.writers.at(i);
        const bool isName = !name.isEmpty() && name.size() <= longestNodeName && name == name.trimmed()
            && !name.contains(QLatin1Char('>'));
        if (!isName)
            complaints->append(
                {SignalKey::Writer,
                 QStringLiteral("%1 is not a valid node name; write 1 ... %2 characters for each writer, and "
                                "'>' between two of them")
                     .arg(quoted(name))
                     .arg(longestNodeName)});
        else if (signal.writers.indexOf(name) < i)
            complaints->append({SignalKey::Writer,
                                QStringLiteral("the node %1 is named twice; name each writer once").arg(quoted(name))});
    }
    checkText(SignalKey::Writer, writersText(signal.writers), LineBreaks::Refused, complaints);
}

void checkSlope(const QPlcSignalDefinition &signal, Complaints *complaints)
{
    if (!std::isfinite(signal.slope) || signal.slope < 0.0)
        complaints->append({SignalKey::Slope,
                            QStringLiteral("the slope %1 is not a positive number; write 'slope = 5 per second'")
                                .arg(QPlcValue(signal.slope).toString())});
    else if (signal.slope > 0.0 && !signal.type.isReal())
        complaints->append({SignalKey::Slope,
                            QStringLiteral("%1 cannot change gradually; remove 'slope =', or use a real type")
                                .arg(signal.type.name())});
}

QString iniLine(SignalKey key, const QString &value)
{
    return signalKeyNames().at(int(key)) + QStringLiteral(" = ") + value;
}

// Long lists do without blanks.
QString listText(const QPlcValue &value)
{
    QString text = value.toString();
    if (value.type().isString())
        return IniParser::valueText(text);
    if (text.size() > IniParser::MaximumLine / 2)
        text.remove(QLatin1Char(' '));
    return text;
}

void checkLine(SignalKey key, const QString &value, Complaints *complaints)
{
    const int size = iniLine(key, value).toUtf8().size();
    if (size > IniParser::MaximumLine)
        complaints->append({key,
                            QStringLiteral("its line in the table has %1 bytes; shorten it to at most %2")
                                .arg(size)
                                .arg(IniParser::MaximumLine)});
}

// Only a value that may be too long is made into a line.
void checkLines(const QPlcSignalDefinition &signal, Complaints *complaints)
{
    constexpr int longText = IniParser::MaximumLine / 8;
    constexpr int longValue = 128;  // [byte]
    if (signal.unit.size() > longText)
        checkLine(SignalKey::Unit, IniParser::valueText(signal.unit), complaints);
    if (signal.description.size() > longText)
        checkLine(SignalKey::Description, IniParser::valueText(signal.description), complaints);
    if (!signal.valueNames.isEmpty())
        checkLine(SignalKey::Values, IniParser::valueText(signal.valueNames.toText()), complaints);
    checkLine(SignalKey::Writer, IniParser::valueText(writersText(signal.writers)), complaints);
    if (signal.type.size() > longValue) {
        checkLine(SignalKey::Initial, listText(signal.initial), complaints);
        checkLine(SignalKey::Safe, listText(signal.safe), complaints);
    }
}

}  // namespace

QString writersText(const QStringList &writers)
{
    return writers.join(QStringLiteral(" > "));
}

QString slopeText(double slope)
{
    return QPlcValue(slope).toString() + perSecond();
}

double slopeFromText(const QString &text)
{
    if (!text.endsWith(perSecond()))
        return 0.0;
    const QString number = text.left(text.size() - perSecond().size()).trimmed();
    const QPlcValue value = QPlcValue::fromString(QPlcSignalType(QPlcSignalType::Real64), number);
    return value.isValid() && value.isFinite() && value.toReal() > 0.0 ? value.toReal() : 0.0;
}

const QStringList &signalKeyNames()
{
    static const QStringList names
        = {QStringLiteral("type"),    QStringLiteral("unit"),    QStringLiteral("description"), QStringLiteral("min"),
           QStringLiteral("max"),     QStringLiteral("initial"), QStringLiteral("safe"),        QStringLiteral("hold"),
           QStringLiteral("values"),  QStringLiteral("writer"),  QStringLiteral("nan"),         QStringLiteral("slope"),
           QStringLiteral("volatile")};
    return names;
}

QVector<Complaint> complaintsAbout(const QPlcSignalDefinition &signal)
{
    Complaints complaints;
    checkName(signal.name, &complaints);
    checkText(SignalKey::Unit, signal.unit, LineBreaks::Refused, &complaints);
    checkText(SignalKey::Description, signal.description, LineBreaks::Allowed, &complaints);
    if (signal.hold && *signal.hold < 0)
        complaints.append({SignalKey::Hold,
                           QStringLiteral("a value cannot be held for %1 cycles; give at least 0").arg(*signal.hold)});
    checkWriters(signal, &complaints);
    const int before = complaints.size();
    if (!signal.type.isValid())
        complaints.append({SignalKey::Type, QStringLiteral("the type is not valid; take one of the table's types")});
    checkType(SignalKey::Initial, signal.initial, signal.type, &complaints);
    checkType(SignalKey::Safe, signal.safe, signal.type, &complaints);
    if (complaints.size() == before)
        checkValues(signal, &complaints);
    if (signal.type.isValid()) {
        checkNames(signal, &complaints);
        checkSlope(signal, &complaints);
    }
    checkLines(signal, &complaints);
    return complaints;
}

QByteArray safetyLine(const QPlcSignalDefinition &signal)
{
    // Bytes, because a number has several texts.
    const auto hex = [](const QPlcValue &value) { return value.isValid() ? value.toBytes().toHex() : QByteArray(); };
    const QByteArray slope = signal.slope > 0.0 ? hex(QPlcValue(signal.slope)) : QByteArray();
    const QByteArray hold = signal.hold ? QByteArray::number(*signal.hold) : QByteArray();
    const QByteArray nan = signal.nanAllowed ? nanAllowedText().toLatin1() : QByteArray();
    const QByteArrayList parts = {hex(signal.minimum), hex(signal.maximum), hex(signal.safe), hold, nan, slope};
    return parts.join(':') + ':' + writersText(signal.writers).toUtf8() + '\n';
}

QString iniSection(const QPlcSignalDefinition &signal)
{
    QStringList lines = {QLatin1Char('[') + signal.name + QLatin1Char(']'), iniLine(SignalKey::Type, signal.typeName)};
    if (!signal.unit.isEmpty())
        lines.append(iniLine(SignalKey::Unit, IniParser::valueText(signal.unit)));
    if (!signal.description.isEmpty())
        lines.append(iniLine(SignalKey::Description, IniParser::valueText(signal.description)));
    if (signal.minimum.isValid())
        lines.append(iniLine(SignalKey::Minimum, signal.minimum.toString()));
    if (signal.maximum.isValid())
        lines.append(iniLine(SignalKey::Maximum, signal.maximum.toString()));
    if (signal.initial != QPlcValue(signal.type))
        lines.append(iniLine(SignalKey::Initial, listText(signal.initial)));
    if (signal.safe.isValid())
        lines.append(iniLine(SignalKey::Safe, listText(signal.safe)));
    if (signal.hold)
        lines.append(iniLine(SignalKey::Hold, QString::number(*signal.hold)));
    if (!signal.valueNames.isEmpty())
        lines.append(iniLine(SignalKey::Values, IniParser::valueText(signal.valueNames.toText())));
    if (!signal.writers.isEmpty())
        lines.append(iniLine(SignalKey::Writer, IniParser::valueText(writersText(signal.writers))));
    if (signal.nanAllowed)
        lines.append(iniLine(SignalKey::Nan, nanAllowedText()));
    if (signal.slope > 0.0)
        lines.append(iniLine(SignalKey::Slope, slopeText(signal.slope)));
    if (signal.isVolatile)
        lines.append(iniLine(SignalKey::Volatile, volatileText()));
    return lines.join(QLatin1Char('\n')) + QLatin1Char('\n');
}

}  // namespace qplc
