// SPDX-License-Identifier: Apache-2.0
#include "QPlcSignalType.h"

#include "MessageText.h"

#include <QtCore/QStringList>

namespace {

struct KnownType
{
    const char *name;
    QPlcSignalType type;
};

// The canonical name of a scalar comes before its other names.
constexpr KnownType knownTypes[] = {
    {"Int8", QPlcSignalType::Int8},
    {"Bool", QPlcSignalType::Int8},
    {"Int16", QPlcSignalType::Int16},
    {"Int32", QPlcSignalType::Int32},
    {"Int", QPlcSignalType::Int32},
    {"Int64", QPlcSignalType::Int64},
    {"UInt8", QPlcSignalType::UInt8},
    {"Byte", QPlcSignalType::UInt8},
    {"UInt16", QPlcSignalType::UInt16},
    {"UInt32", QPlcSignalType::UInt32},
    {"UInt", QPlcSignalType::UInt32},
    {"UInt64", QPlcSignalType::UInt64},
    {"Real32", QPlcSignalType::Real32},
    {"Real", QPlcSignalType::Real32},
    {"Real64", QPlcSignalType::Real64},
    {"Real32Triple", {QPlcSignalType::Real32, 3}},
    {"RealTriple", {QPlcSignalType::Real32, 3}},
    {"Real64Triple", {QPlcSignalType::Real64, 3}},
    {"String", QPlcSignalType::String},
    {"DateTime", QPlcSignalType::DateTime},
};

QPlcSignalType typeWithoutSize(const QString &name)
{
    for (const KnownType &known : knownTypes) {
        if (name == QLatin1String(known.name))
            return known.type;
    }
    return QPlcSignalType();
}

QString scalarName(QPlcSignalType::Scalar scalar)
{
    for (const KnownType &known : knownTypes) {
        if (known.type.scalar() == scalar)
            return QString::fromLatin1(known.name);
    }
    return QStringLiteral("Invalid");
}

QString unknownType(const QString &name)
{
    QStringList names;
    for (const KnownType &known : knownTypes)
        names.append(QString::fromLatin1(known.name));
    const QStringList close = qplc::closeNames(name, names);
    const QString text = QStringLiteral("unknown type ") + qplc::quoted(name);
    if (!close.isEmpty())
        return text + qplc::didYouMean(close);
    return text + QStringLiteral("; write one of ") + names.join(QStringLiteral(", "));
}

// The number of up to six digits in `text`, 0 when there is none.
int sizeFromText(const QString &text)
{
    constexpr int mostDigits = 6;
    for (const QChar digit : text) {
        if (digit < QLatin1Char('0') || digit > QLatin1Char('9'))
            return 0;
    }
    return text.size() > mostDigits ? 0 : text.toInt();
}

// What is wrong with `base`, the name in front of a size in brackets; empty: nothing.
QString wrongBase(const QString &name, const QString &base, QChar bracket)
{
    const QPlcSignalType type = typeWithoutSize(base);
    if (!type.isValid())
        return unknownType(base);
    if (type.isArray() || type.isDateTime())
        return QStringLiteral("type %1: a %2 has no size of its own; arrays are made of numbers, like Real32[6]")
            .arg(qplc::quoted(name), base);
    if (bracket == QLatin1Char(type.isString() ? '(' : '['))
        return QString();
    return QStringLiteral("type %1: write the size as in '%2'")
        .arg(qplc::quoted(name), type.isString() ? QStringLiteral("String(64)") : base + QStringLiteral("[3]"));
}

QString tooLarge(const QString &name, QPlcSignalType element)
{
    const int most
        = element.isString() ? QPlcSignalType::MaximumSize - 2 : QPlcSignalType::MaximumSize / element.elementSize();
    return QStringLiteral("type %1 is too large: a signal has at most %2 bytes; write a size of at most %3")
        .arg(qplc::quoted(name))
        .arg(QPlcSignalType::MaximumSize)
        .arg(most);
}

QPlcSignalType typeWithSize(const QString &name, int bracket, QString *error)
{
    const QString base = name.left(bracket);
    *error = wrongBase(name, base, name.at(bracket));
    if (!error->isEmpty())
        return QPlcSignalType();
    const QPlcSignalType element = typeWithoutSize(base);
    const QChar closing = QLatin1Char(element.isString() ? ')' : ']');
    const int count = name.endsWith(closing) ? sizeFromText(name.mid(bracket + 1, name.size() - bracket - 2)) : 0;
    const QPlcSignalType type = count > 0 ? QPlcSignalType(element.scalar(), count) : QPlcSignalType();
    if (count == 0)
        *error = QStringLiteral("type %1: the size must be a whole number of at least 1; write, for example, '%2'")
                     .arg(qplc::quoted(name),
                          element.isString() ? QStringLiteral("String(64)") : base + QStringLiteral("[3]"));
    else if (!type.isValid())
        *error = tooLarge(name, element);
    return type;
}

}  // namespace

QPlcSignalType QPlcSignalType::fromName(const QString &name, QString *error)
{
    QString reason;
    QPlcSignalType type = typeWithoutSize(name);
    if (!type.isValid()) {
        const int square = name.indexOf(QLatin1Char('['));
        const int bracket = square >= 0 ? square : name.indexOf(QLatin1Char('('));
        if (bracket >= 0)
            type = typeWithSize(name, bracket, &reason);
        else
            reason = unknownType(name);
    }
    if (error)
        *error = reason;
    return type;
}

QString QPlcSignalType::name() const
{
    const QString scalarText = scalarName(m_scalar);
    if (isString())
        return scalarText + QStringLiteral("(%1)").arg(capacity());
    return isArray() ? scalarText + QStringLiteral("[%1]").arg(count()) : scalarText;
}
