// SPDX-License-Identifier: Apache-2.0
#include "DbcFile.h"

#include "DbcParser.h"
#include "DbcReader.h"
#include "signals/BoundedRead.h"

#include <QtCore/QFile>
#include <QtCore/QTextCodec>

#include <algorithm>

namespace qplc {

namespace {

QString textOfDbc(const QByteArray &bytes)
{
    QTextCodec::ConverterState state;
    const QString text = QTextCodec::codecForName("UTF-8")->toUnicode(bytes.constData(), bytes.size(), &state);
    return state.invalidChars == 0 && state.remainingChars == 0 ? text : QString::fromLatin1(bytes);
}

QVector<QPlcParseError> dbcError(const QString &fileName, const QString &message)
{
    return {{fileName, 0, 0, message}};
}

}  // namespace

const DbcSignal *DbcMessage::find(const QString &signal) const
{
    const auto isNamed = [&signal](const DbcSignal &part) { return part.name == signal; };
    const auto found = std::find_if(content.cbegin(), content.cend(), isNamed);
    return found == content.cend() ? nullptr : &*found;
}

const DbcMessage *DbcFile::find(const QString &message) const
{
    const auto isNamed = [&message](const DbcMessage &one) { return one.name == message; };
    const auto found = std::find_if(m_messages.cbegin(), m_messages.cend(), isNamed);
    return found == m_messages.cend() ? nullptr : &*found;
}

DbcFile DbcFile::fromText(const QByteArray &text, const QString &fileName, QVector<QPlcParseError> *errors)
{
    DbcFile file;
    errors->clear();
    if (text.size() > MaximumSize) {
        *errors = dbcError(fileName,
                           QStringLiteral("the file has %1 bytes; remove the messages that you do not need, at most %2 "
                                          "bytes are read")
                               .arg(text.size())
                               .arg(MaximumSize));
        return file;
    }
    if (text.contains('\0')) {
        *errors
            = dbcError(fileName, QStringLiteral("byte 0x00: this is not a text; give a DBC file in UTF-8 or Latin-1"));
        return file;
    }
    file.m_messages = parseDbc(textOfDbc(text), fileName, errors);
    if (errors->isEmpty() && file.isEmpty())
        *errors = dbcError(fileName, QStringLiteral("there is no message (BO_) in the file; give a DBC file"));
    return file;
}

DbcFile DbcFile::fromFile(const QString &fileName, QVector<QPlcParseError> *errors)
{
    QFile file(fileName);
    if (!file.open(QIODevice::ReadOnly)) {
        *errors = dbcError(fileName,
                           QStringLiteral("cannot read the DBC file: %1; correct the key dbc").arg(file.errorString()));
        return {};
    }
    return fromText(readBounded(&file, MaximumSize), fileName, errors);
}

bool DbcFile::readSignal(const QString &text, DbcSignal *signal, QString *error)
{
    DbcReader reader(text, QString());
    bool isExtended = false;
    bool isRead = reader.expectRole(signal, &isExtended) && reader.expectPlace(signal);
    if (isRead && !reader.atEnd())
        isRead = reader.fail(reader.peek(), QStringLiteral("stray %1 at the end").arg(reader.peek().shown()));
    if (!isRead)
        *error = reader.errors().constFirst().message;
    return isRead;
}

QString DbcFile::problemOf(const DbcMessage &message, const DbcSignal &signal)
{
    if (message.find(signal.name))
        return QStringLiteral("message '%1' has two signals '%2'; give each its own name")
            .arg(message.name, signal.name);
    if (signal.neededBytes() > message.size)
        return QStringLiteral("signal '%1' has %2 bits from bit %3 on (%4) and ends in byte %5, but message '%6' has "
                              "only %7 bytes")
            .arg(signal.name)
            .arg(signal.length)
            .arg(signal.start)
            .arg(signal.byteOrder == DbcSignal::Intel ? QStringLiteral("Intel") : QStringLiteral("Motorola"))
            .arg(signal.neededBytes() - 1)
            .arg(message.name)
            .arg(message.size);
    if (signal.isFloat() && signal.length != (signal.kind == DbcSignal::Float32 ? 32 : 64))
        return QStringLiteral("signal '%1' has %2 bits; a float has 32 or 64").arg(signal.name).arg(signal.length);
    if (signal.role == DbcSignal::Multiplexor && signal.isFloat())
        return QStringLiteral("the multiplexor '%1' is a float; it has to be an integer").arg(signal.name);
    return {};
}

}  // namespace qplc
