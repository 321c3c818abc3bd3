// SPDX-License-Identifier: Apache-2.0
#include "CanOpenConfiguration.h"

#include "CanOpenIds.h"
#include "QPlcDriverSettings.h"
#include "hardware/can/CanConfiguration.h"
#include "signals/ConfigurationFile.h"
#include "signals/DurationText.h"
#include "signals/MessageText.h"

#include <QtCore/QHash>
#include <QtCore/QRegularExpression>

#include <algorithm>
#include <cmath>

namespace qplc {

namespace {

using namespace std::chrono_literals;

constexpr int defaultPdos = 4;  // that have an id by default

constexpr AxisMode axisModes[] = {AxisMode::SyncVelocity,    AxisMode::SyncTorque,    AxisMode::SyncPosition,
                                  AxisMode::ProfileVelocity, AxisMode::ProfileTorque, AxisMode::Homing};

}  // namespace

void CanOpenConfiguration::read(QPlcDriverSettings &settings)
{
    device = settings.requiredText(QStringLiteral("device"), QStringLiteral("can0"));
    bitRate = readBitRate(device, settings);
    sync = SyncSource(
        settings.choice(QStringLiteral("sync"),
                        {QStringLiteral("none"), QStringLiteral("every cycle"), QStringLiteral("from others")}));
    if (sync == SyncSource::EveryCycle && !device.isEmpty())
        settings.claim(QStringLiteral("sync"), QStringLiteral("sending the SYNC of %1").arg(device));
    if (settings.has(QStringLiteral("node")))
        readNode(settings);
    else if (sync != SyncSource::EveryCycle)
        settings.addError({},
                          QStringLiteral("section '%1' names no node; add for example 'node = 5', or 'sync = every "
                                         "cycle' for a section that only sends the SYNC of the bus")
                              .arg(settings.name()));
}

int CanOpenConfiguration::readBitRate(const QString &device, QPlcDriverSettings &settings)
{
    return CanConfiguration::readBitRate(device, QStringLiteral("bitrate"), 10000, 1'000'000, settings);
}

/// Of a device, or of the master in its heartbeats.
QString CanOpenConfiguration::placeOf(int id) const
{
    return QStringLiteral("node %1 of %2").arg(id).arg(device);
}

void CanOpenConfiguration::readNode(QPlcDriverSettings &settings)
{
    node = int(settings.integer(QStringLiteral("node"), 1, 1, CanOpenIds::MaximumNode));
    if (!device.isEmpty())
        settings.claim(QStringLiteral("node"), placeOf(node));
    master = int(settings.integer(QStringLiteral("master"), 127, 0, CanOpenIds::MaximumNode));
    if (master == node)
        settings.addError(QStringLiteral("master"),
                          QStringLiteral("the master cannot have the id %1 of the device; take a free one, or 0 for no "
                                         "heartbeat of the master")
                              .arg(master));
    else if (master > 0 && !device.isEmpty())
        settings.claim(QStringLiteral("master"), placeOf(master), QStringLiteral("master"));
    heartbeat = std::chrono::duration_cast<std::chrono::milliseconds>(
        settings.duration(QStringLiteral("heartbeat"), 100ms, 10ms, 30s));
    answerTime = settings.duration(QStringLiteral("sdo-timeout"), 200ms, 10ms, 1s);
    readEds(settings);
    readIdentity(settings);
    readAxis(settings);
    readSettings(settings);
    const bool hasKeys = !settings.namesBehind(QStringLiteral("tpdo")).isEmpty()
        || !settings.namesBehind(QStringLiteral("rpdo")).isEmpty();
    readPdos(true, settings);
    readPdos(false, settings);
    if (!hasKeys && isAxis)
        addPdosOfAxis();
    else if (!hasKeys) {
        addPdosOfFile(true, settings);
        addPdosOfFile(false, settings);
    }
    if (!hasKeys && pdos.isEmpty())
        settings.addError({},
                          QStringLiteral("section '%1' has no PDO, so no value; add for example 'tpdo1 = 6041:00, "
                                         "606C:00', 'profile = 402', or the EDS file of the device")
                              .arg(settings.name()));
    checkIds(settings);
    checkWriters(settings);
    checkTimes(settings);
    checkAxis(settings);
}

void CanOpenConfiguration::readEds(QPlcDriverSettings &settings)
{
    const QString fileName = settings.fileName(QStringLiteral("eds"));
    if (fileName.isEmpty())
        return;
    QVector<QPlcParseError> errors;
    m_file = EdsFile::fromFile(fileName, node, &errors);
    settings.addErrors(errors);
}

// What the keys do not say is said by the file.
void CanOpenConfiguration::readIdentity(QPlcDriverSettings &settings)
{
    constexpr qint64 largest = 0xFFFFFFFF;
    identity.vendor = quint32(settings.integer(QStringLiteral("vendor"), m_file.vendor(), 0, largest));
    identity.product = quint32(settings.integer(QStringLiteral("product"), m_file.product(), 0, largest));
    identity.revision = quint32(settings.integer(QStringLiteral("revision"), 0, 0, largest));
    identity.serial = quint32(settings.integer(QStringLiteral("serial"), 0, 0, largest));
}

void CanOpenConfiguration::readAxis(QPlcDriverSettings &settings)
{
    isAxis = settings.choice(QStringLiteral("profile"), {QStringLiteral("none"), QStringLiteral("402")}) == 1;
    if (!isAxis)
        return;
    QStringList words;
    for (const AxisMode one : axisModes)
        words << Cia402Axis::modeText(one);
    mode = axisModes[settings.choice(QStringLiteral("mode"), words)];
    constexpr double most = 4294967295.0;
    limits.velocity = settings.number(QStringLiteral("limit.velocity"), limits.velocity, 0.0, most);
    limits.torque = settings.number(QStringLiteral("limit.torque"), limits.torque, 0.0, most);
    limits.lowestPosition = settings.number(QStringLiteral("limit.position-min"), limits.lowestPosition, -most, most);
    limits.highestPosition = settings.number(QStringLiteral("limit.position-max"), limits.highestPosition, -most, most);
    if (limits.lowestPosition > limits.highestPosition)
        settings.addError(QStringLiteral("limit.position-min"),
                          QStringLiteral("limit.position-min = %1 is above limit.position-max = %2; exchange them")
                              .arg(limits.lowestPosition)
                              .arg(limits.highestPosition));
}

// ---- settings ----

// set.6085:00 = 3000, or with a type: set.2001:03 = 5 u16
void CanOpenConfiguration::readSettings(QPlcDriverSettings &keys)
{
    for (const QString &name : keys.namesBehind(QStringLiteral("set."))) {
        const QString key = QStringLiteral("set.") + name;
        const QString text = keys.text(key);
        CanOpenSetting setting;
        QString error;
        const CanOpenObject *object = objectOf(name);
        const auto address = ObjectAddress::fromText(name);
        if (!address && !object) {
            keys.addError(key,
                          QStringLiteral("there is no object '%1'; write its address (set.6085:00 = 3000)%2")
                              .arg(name, didYouMean(closeNames(name, objectNames()))));
            continue;
        }
        setting.address = address ? *address : object->address;
        if (readSetting(text, &setting, &error))
            startValues.append(setting);
        else
            keys.addError(key, error);
    }
}

bool CanOpenConfiguration::readSetting(const QString &text, CanOpenSetting *setting, QString *error) const
{
    const CanOpenObject *object = objectOf(setting->address.toText());
    const QString word = text.section(QLatin1Char(' '), 1).trimmed();
    const std::optional<RawNumber> number
        = word.isEmpty() ? (object ? object->number : std::nullopt) : CanOpenObject::numberOfWord(word);
    const QString digits = text.section(QLatin1Char(' '), 0, 0);
    bool isNumber = false;
    double value = double(digits.toLongLong(&isNumber, 0));
    isNumber = isNumber || finiteNumberFromText(digits, &value);
    const QString where = setting->address.toText();
    if (!number) {
        *error
            = QStringLiteral("the type of object %1 is not known; write it behind the value: set.%1 = %2 u16 (or u8, "
                             "u32, i8, i16, i32, f32, ...), or name an EDS file")
                  .arg(where, digits);
        return false;
    }
    RawNumber::Fit fit = RawNumber::Fits;
    const quint64 bits = number->encode(value, &fit);
    if (!isNumber || fit != RawNumber::Fits || (number->kind != RawNumber::Float && value != std::floor(value))) {
        *error = QStringLiteral("%1 is not a value of object %2, which has %3 bits%4")
                     .arg(quoted(digits), where)
                     .arg(number->bits)
                     .arg(number->kind == RawNumber::Unsigned ? QStringLiteral(" without a sign") : QString());
        return false;
    }
    setting->value = littleEndian(bits, (number->bits + 7) / 8);
    return true;
}

// ---- PDOs ----

void CanOpenConfiguration::readPdos(bool isTransmit, QPlcDriverSettings &settings)
{
    const QString prefix = isTransmit ? QStringLiteral("tpdo") : QStringLiteral("rpdo");
    for (const QString &name : settings.namesBehind(prefix)) {
        const QString key = prefix + name;
        const QStringList words = settings.list(key);
        bool isNumber = false;
        Pdo pdo;
        pdo.isTransmit = isTransmit;
        pdo.number = name.toInt(&isNumber);
        QString error;
        if (!isNumber || pdo.number < 1 || pdo.number > Pdo::MaximumNumber || name != QString::number(pdo.number))
            error = QStringLiteral("'%1' is no PDO; write %2 with a number from 1 to %3")
                        .arg(key, prefix)
                        .arg(Pdo::MaximumNumber);
        else
            readPdo(words, &pdo, &error);
        if (error.isEmpty())
            pdos.append(pdo);
        else
            settings.addError(key, error);
    }
}

bool CanOpenConfiguration::readPdo(const QStringList &words, Pdo *pdo, QString *error) const
{
    pdo->transmission = sync == SyncSource::Nobody ? Pdo::OnEvent : Pdo::EverySync;
    pdo->eventTime = sync == SyncSource::Nobody && pdo->isTransmit ? 10 : 0;
    pdo->id = pdo->number <= defaultPdos ? CanOpenIds::pdo(pdo->number, pdo->isTransmit, node) : 0;
    for (const QString &word : words) {
        if (!readPdoWord(word, pdo, error))
            return false;
    }
    if (pdo->entries.isEmpty())
        *error = QStringLiteral("%1 has no object; write for example '6041:00, 606C:00'").arg(pdo->title());
    else if (pdo->bits() > Pdo::MaximumBits)
        *error = QStringLiteral("%1 has %2 bits, and a frame has %3; put some of the objects into another PDO")
                     .arg(pdo->title())
                     .arg(pdo->bits())
                     .arg(Pdo::MaximumBits);
    else if (pdo->id == 0)
        *error
            = QStringLiteral("%1 has no id by default, as only the PDOs 1 to 4 have one; write 'id 0x...' before its "
                             "objects")
                  .arg(pdo->title());
    else if (pdo->isSynchronous() && sync == SyncSource::Nobody)
        *error
            = QStringLiteral("%1 waits for SYNC; add 'sync = every cycle', or 'sync = from others' if another section "
                             "or device sends it")
                  .arg(pdo->title());
    return error->isEmpty();
}

bool CanOpenConfiguration::readPdoWord(const QString &word, Pdo *pdo, QString *error) const
{
    static const QRegularExpression syncs(QStringLiteral("^every ([0-9]{1,3}) syncs$"));
    static const QRegularExpression ids(QStringLiteral("^id (0x[0-9A-Fa-f]{1,3}|[0-9]{1,4})$"));
    double time = 0.0;  // [ns]
    if (word == QLatin1String("every sync")) {
        pdo->transmission = Pdo::EverySync;
    } else if (word == QLatin1String("on event")) {
        pdo->transmission = Pdo::OnEvent;
        pdo->eventTime = 0;
    } else if (const QRegularExpressionMatch match = syncs.match(word); match.hasMatch()) {
        pdo->transmission = match.captured(1).toInt();
        if (pdo->transmission < 1 || pdo->transmission > Pdo::LastSynchronous)
            *error = QStringLiteral("'%1' is not possible; write every 1 ... %2 syncs")
                         .arg(word)
                         .arg(Pdo::LastSynchronous);
    } else if (ids.match(word).hasMatch()) {
        pdo->id = word.mid(3).toUInt(nullptr, 0);
        if (!CanOpenIds::isPdo(pdo->id))
            *error = QStringLiteral("'%1' is no id of a PDO; take one from 0x181 to 0x57F").arg(word);
    } else if (pdo->isTransmit && word.startsWith(QLatin1String("every ")) && durationFromText(word.mid(6), &time)) {
        pdo->transmission = Pdo::OnEvent;
        pdo->eventTime = int(std::lround(std::min(time, 1e12) / 1e6));
        if (pdo->eventTime < 1 || pdo->eventTime > 65535)
            *error = QStringLiteral("'%1' is not possible; write every 1 ms ... every 65 s").arg(word);
    } else {
        PdoEntry entry;
        if (readEntry(word, &entry, error))
            pdo->entries.append(entry);
    }
    return error->isEmpty();
}

// "6041:00", "2001:03 u16", or a name of the EDS file or the standard
bool CanOpenConfiguration::readEntry(const QString &word, PdoEntry *entry, QString *error) const
{
    const QString name = word.section(QLatin1Char(' '), 0, 0);
    const QString type = word.section(QLatin1Char(' '), 1).trimmed();
    const auto address = ObjectAddress::fromText(name);
    const CanOpenObject *object = objectOf(name);
    if (object) {
        *entry = {object->address, object->name, object->number.value_or(RawNumber{RawNumber::Unsigned, 0}),
                  object->value.value_or(0)};
    } else if (address) {
        const bool isDummy = address->index < 0x20 && address->sub == 0;
        entry->address = *address;
        entry->number = (isDummy ? CanOpenObject::numberOfType(address->index) : std::nullopt)
                            .value_or(RawNumber{RawNumber::Unsigned, 0});
    } else {
        *error = QStringLiteral("there is no object '%1'; write its address, for example 6041:00%2")
                     .arg(name, didYouMean(closeNames(name, objectNames())));
        return false;
    }
    if (!type.isEmpty()) {
        const auto number = CanOpenObject::numberOfWord(type);
        if (!number) {
            *error
                = QStringLiteral("'%1' is no type; write bool, u8, u16, u24, u32, u64, i8, ..., f32 or f64").arg(type);
            return false;
        }
        entry->number = *number;
    }
    if (entry->number.bits == 0)
        *error = QStringLiteral("the type of object '%1' is not known, or no number; write it behind the object: '%1 "
                                "u16', or name an EDS file")
                     .arg(name);
    return error->isEmpty();
}

// As the device has them by default.
void CanOpenConfiguration::addPdosOfFile(bool isTransmit, QPlcDriverSettings &settings)
{
    const CanOpenDictionary &objects = m_file.dictionary();
    const auto valueOf = [&](quint16 index, int sub) {
        const CanOpenObject *object = objects.find(ObjectAddress{index, quint8(sub)});
        return object ? object->value : std::nullopt;
    };
    for (int number = 1; number <= Pdo::MaximumNumber; ++number) {
        Pdo pdo;
        pdo.number = number;
        pdo.isTransmit = isTransmit;
        const quint64 id = valueOf(pdo.communicationIndex(), 1).value_or(Pdo::IsOff);
        const int count = int(std::min<quint64>(valueOf(pdo.mappingIndex(), 0).value_or(0), 64));
        if ((id & Pdo::IsOff) || count == 0)
            continue;
        pdo.id = quint32(id & 0x7FF);
        pdo.transmission = int(valueOf(pdo.communicationIndex(), 2).value_or(Pdo::OnEvent) & 0xFF);
        if (pdo.transmission == 0)
            pdo.transmission = Pdo::EverySync;
        pdo.eventTime = int(valueOf(pdo.communicationIndex(), 5).value_or(0) & 0xFFFF);
        const CanOpenObject *mapping = objects.find(ObjectAddress{pdo.mappingIndex(), 0});
        pdo.isFixed = !mapping->isWritable;
        for (int sub = 1; sub <= count; ++sub) {
            const quint64 entry = valueOf(pdo.mappingIndex(), sub).value_or(0);
            const int bits = int(entry & 0xFF);
            if (entry != 0 && bits <= Pdo::MaximumBits)
                pdo.entries.append(entryOf({quint16(entry >> 16), quint8(entry >> 8)}, bits));
        }
        const QString problem = problemOfFile(pdo);
        if (!problem.isEmpty())
            settings.addError(QStringLiteral("eds"), problem);
        else if (!pdo.entries.isEmpty())
            pdos.append(pdo);
        if (problem.isEmpty() && pdo.isSynchronous() && sync == SyncSource::Nobody)
            settings.addWarning(
                QStringLiteral("eds"),
                QStringLiteral("%1 of the file waits for SYNC; add 'sync = every cycle', or 'sync = from "
                               "others' if another section or device sends it")
                    .arg(pdo.title()));
    }
}

// With an id of network management or SYNC, the values of a PDO would command all devices of the
// bus.
QString CanOpenConfiguration::problemOfFile(const Pdo &pdo)
{
    const QString title = QStringLiteral("%1 of the file").arg(pdo.title());
    if (!CanOpenIds::isPdo(pdo.id))
        return QStringLiteral(
                   "%1 has the id 0x%2, which is not one of a PDO (0x181 to 0x57F); correct the file, or write "
                   "the PDOs that you use as keys (tpdo1, rpdo1)")
            .arg(title, QString::number(pdo.id, 16));
    if (pdo.bits() > Pdo::MaximumBits)
        return QStringLiteral("%1 has %2 bits, and a frame has %3; correct the file, or write the PDOs that you use as "
                              "keys (tpdo1, rpdo1)")
            .arg(title)
            .arg(pdo.bits())
            .arg(Pdo::MaximumBits);
    return {};
}

PdoEntry CanOpenConfiguration::entryOf(ObjectAddress address, int bits) const
{
    const CanOpenObject *object = objectOf(address.toText());
    PdoEntry entry;
    entry.address = address;
    entry.number = object && object->number && object->number->bits == bits ? *object->number
                                                                            : RawNumber{RawNumber::Unsigned, bits};
    if (object) {
        entry.name = object->name;
        entry.initial = object->value.value_or(0);
    }
    return entry;
}

// What the modes of a drive need.
void CanOpenConfiguration::addPdosOfAxis()
{
    const ObjectAddress controlword{0x6040, 0};
    const ObjectAddress modes{0x6060, 0};
    switch (mode) {
    case AxisMode::SyncVelocity:
    case AxisMode::ProfileVelocity:
        addPdo(1, false, {controlword, modes, {0x60FF, 0}});
        break;
    case AxisMode::SyncTorque:
    case AxisMode::ProfileTorque:
        addPdo(1, false, {controlword, modes, {0x6071, 0}});
        break;
    case AxisMode::SyncPosition:
        addPdo(1, false, {controlword, modes, {0x607A, 0}});
        break;
    default:
        addPdo(1, false, {controlword, modes});
    }
    addPdo(1, true, {{0x6041, 0}, {0x6061, 0}, {0x606C, 0}});
    addPdo(2, true, {{0x6064, 0}, {0x6077, 0}});
}

void CanOpenConfiguration::addPdo(int number, bool isTransmit, std::initializer_list<ObjectAddress> objects)
{
    Pdo pdo;
    pdo.number = number;
    pdo.isTransmit = isTransmit;
    QStringList words;
    for (const ObjectAddress &address : objects)
        words << address.toText();
    QString error;
    if (readPdo(words, &pdo, &error))
        pdos.append(pdo);
}

void CanOpenConfiguration::checkIds(QPlcDriverSettings &settings)
{
    QHash<quint32, QString> titleOfId;
    for (const Pdo &pdo : qAsConst(pdos)) {
        const QString key = (pdo.isTransmit ? QStringLiteral("tpdo%1") : QStringLiteral("rpdo%1")).arg(pdo.number);
        const QString id = QString::number(pdo.id, 16);
        if (titleOfId.contains(pdo.id))
            settings.addError(key,
                              QStringLiteral("%1 has the id 0x%2 of %3; give each its own")
                                  .arg(pdo.title(), id, titleOfId.value(pdo.id)));
        else if (!device.isEmpty())
            settings.claim(key, QStringLiteral("the PDO id 0x%1 of %2").arg(id, device));
        titleOfId.insert(pdo.id, pdo.title());
    }
}

// Of two PDOs, the one without a writer would give the object its first value again and again.
void CanOpenConfiguration::checkWriters(QPlcDriverSettings &settings)
{
    constexpr quint16 firstObject = 0x20;  // below are dummies, which fill a PDO
    QHash<quint32, QString> titleOfObject;
    for (const Pdo &pdo : qAsConst(pdos)) {
        if (pdo.isTransmit)
            continue;
        for (const PdoEntry &entry : pdo.entries) {
            const quint32 key = entry.address.key();
            if (entry.address.index >= firstObject && titleOfObject.contains(key))
                settings.addError(QStringLiteral("rpdo%1").arg(pdo.number),
                                  QStringLiteral("object %1 is in %2, too; write it in one of them")
                                      .arg(entry.address.toText(), titleOfObject.value(key)));
            titleOfObject.insert(key, pdo.title());
        }
    }
}

void CanOpenConfiguration::checkTimes(QPlcDriverSettings &settings)
{
    for (const Pdo &pdo : qAsConst(pdos)) {
        if (settings.has(QStringLiteral("timeout")) && pdo.isTransmit && !pdo.isSynchronous()
            && timeout < pdo.eventTime * 1ms)
            settings.addError(QStringLiteral("timeout"),
                              QStringLiteral("timeout is shorter than the time of %1 (%2 ms), so its values would be "
                                             "invalid between two frames; write at least that")
                                  .arg(pdo.title())
                                  .arg(pdo.eventTime));
    }
}

std::chrono::nanoseconds CanOpenConfiguration::freshTime(const Pdo &pdo) const
{
    if (pdo.isSynchronous())
        return timeout;
    return pdo.eventTime > 0 ? std::max<std::chrono::nanoseconds>(timeout, 3 * pdo.eventTime * 1ms) : 0ns;
}

// A drive cannot be commanded without these.
void CanOpenConfiguration::checkAxis(QPlcDriverSettings &settings)
{
    int pdo = 0;
    int entry = 0;
    if (isAxis && !find(QStringLiteral("6040:00"), false, &pdo, &entry))
        settings.addError(QStringLiteral("profile"),
                          QStringLiteral("no RPDO has the controlword; add 6040:00, for example 'rpdo1 = 6040:00, "
                                         "6060:00, 60FF:00'"));
    if (isAxis && !find(QStringLiteral("6041:00"), true, &pdo, &entry))
        settings.addError(QStringLiteral("profile"),
                          QStringLiteral("no TPDO has the statusword; add 6041:00, for example 'tpdo1 = 6041:00, "
                                         "6061:00, 606C:00'"));
}

// ---- objects ----

const CanOpenObject *CanOpenConfiguration::objectOf(const QString &text) const
{
    const CanOpenObject *object = m_file.dictionary().find(text);
    return object ? object : CanOpenDictionary::standard().find(text);
}

QStringList CanOpenConfiguration::objectNames() const
{
    QStringList names;
    for (const CanOpenDictionary *dictionary : {&m_file.dictionary(), &CanOpenDictionary::standard()}) {
        for (const CanOpenObject &object : dictionary->objects())
            names << object.name;
    }
    return names;
}

bool CanOpenConfiguration::find(const QString &text, bool isTransmit, int *pdo, int *entry) const
{
    for (int i = 0; i < pdos.size(); ++i) {
        if (pdos.at(i).isTransmit != isTransmit)
            continue;
        *pdo = i;
        *entry = pdos.at(i).find(text);
        if (*entry >= 0)
            return true;
    }
    return false;
}

}  // namespace qplc
