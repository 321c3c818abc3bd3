// SPDX-License-Identifier: Apache-2.0
#include "DbcFile.h"

#include "CanFrame.h"
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

bool DbcMessage::isMultiplexed() const
{
    return std::any_of(content.cbegin(), content.cend(), [](const DbcSignal &part) { return part.isMultiplexed(); });
}

// A multiplexor that is multiplexed itself belongs to the one that always is in the frame.
QString DbcMessage::connectMultiplexors()
{
    QVector<int> all;
    QVector<int> always;
    for (int i = 0; i < content.size(); ++i) {
        if (content.at(i).isMultiplexor)
            (content.at(i).isMultiplexed() ? all : always).append(i);
    }
    all = always + all;
    for (DbcSignal &part : content) {
        if (!part.isMultiplexed() || part.multiplexor >= 0)
            continue;
        const QVector<int> &candidates = part.isMultiplexor ? always : all;
        if (candidates.isEmpty())
            return QStringLiteral("it has multiplexed signals and no multiplexor (M)");
        if (candidates.size() > 1)
            return QStringLiteral("it has several multiplexors, and no line SG_MUL_VAL_ says to which one signal '%1' "
                                  "belongs; add it to the file")
                .arg(part.name);
        part.multiplexor = candidates.first();
    }
    for (const DbcSignal &part : qAsConst(content)) {
        if (depthOf(part) > content.size())
            return QStringLiteral("signal '%1' is selected by itself, over its multiplexors; correct the lines "
                                  "SG_MUL_VAL_ of the file")
                .arg(part.name);
    }
    return {};
}

int DbcMessage::depthOf(const DbcSignal &signal) const noexcept
{
    int depth = 0;
    for (int i = signal.multiplexor; i >= 0 && depth <= content.size(); i = content.at(i).multiplexor)
        ++depth;
    return depth;
}

bool DbcMessage::isThere(const DbcSignal &signal, const quint8 *data) const noexcept
{
    const DbcSignal *part = &signal;
    while (part->multiplexor >= 0) {
        const DbcSignal &multiplexor = content.at(part->multiplexor);
        if (!part->isOnPage(multiplexor.bits(data)))
            return false;
        part = &multiplexor;
    }
    return true;
}

bool DbcMessage::hasPage(const quint8 *data) const noexcept
{
    return std::any_of(content.cbegin(), content.cend(),
                       [this, data](const DbcSignal &part) { return part.isMultiplexed() && isThere(part, data); });
}

namespace {

// Whether two signals can be in one frame: no multiplexor has to have two values.
bool canMeet(const DbcMessage &message, const DbcSignal &a, const DbcSignal &b)
{
    const auto meet = [](const DbcSignal &one, const DbcSignal &other) {
        return std::any_of(one.pages.cbegin(), one.pages.cend(), [&other](const DbcSignal::Range &range) {
            return std::any_of(other.pages.cbegin(), other.pages.cend(), [&range](const DbcSignal::Range &second) {
                return range.first <= second.last && second.first <= range.last;
            });
        });
    };
    for (const DbcSignal *one = &a; one->multiplexor >= 0; one = &message.content.at(one->multiplexor)) {
        for (const DbcSignal *other = &b; other->multiplexor >= 0; other = &message.content.at(other->multiplexor)) {
            if (one->multiplexor == other->multiplexor && !meet(*one, *other))
                return false;
        }
    }
    return true;
}

}  // namespace

bool DbcMessage::overlap(const DbcSignal &a, const DbcSignal &b) const
{
    return (a.places() & b.places()).any() && canMeet(*this, a, b);
}

QVector<QPair<QString, QString>> DbcMessage::overlappingSignals() const
{
    constexpr int mostSignals = 1000;
    constexpr int mostPairs = 20;
    QVector<QPair<QString, QString>> pairs;
    QVector<DbcSignal::Bits> places;
    for (const DbcSignal &part : content.mid(0, mostSignals)) {
        const DbcSignal::Bits bits = part.places();
        for (int i = 0; i < places.size() && pairs.size() < mostPairs; ++i) {
            if ((places.at(i) & bits).any() && canMeet(*this, content.at(i), part))
                pairs.append({content.at(i).name, part.name});
        }
        places.append(bits);
    }
    return pairs;
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
    bool isRead = reader.expectRole(signal) && reader.expectPlace(signal);
    if (isRead && !reader.atEnd())
        isRead = reader.fail(reader.peek(), QStringLiteral("stray %1 at the end").arg(reader.peek().shown()));
    if (!isRead)
        *error = reader.errors().constFirst().message;
    return isRead;
}

QString DbcFile::sizeProblemOf(const DbcMessage &message)
{
    if (message.isJ1939 && message.size > 8)
        return QStringLiteral("it has %1 bytes, which J1939 sends in several frames (transport protocol, TP); the "
                              "driver uses messages of J1939 with at most 8 bytes")
            .arg(message.size);
    if (!CanFrame::isSize(message.size, message.isFd))
        return QStringLiteral("it has %1 bytes, which no frame has").arg(message.size);
    return {};
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
    if (signal.isMultiplexor && signal.isFloat())
        return QStringLiteral("the multiplexor '%1' is a float; it has to be an integer").arg(signal.name);
    return {};
}

}  // namespace qplc
