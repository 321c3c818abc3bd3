// SPDX-License-Identifier: Apache-2.0
#include "ModbusDevice.h"
#include "ModbusPlan.h"
#include "QPlcDriverSettings.h"
#include "QPlcReadChannel.h"
#include "QPlcWriteChannel.h"
#include "hardware/DeviceHealth.h"
#include "hardware/Drivers.h"
#include "hardware/HardwareLogging.h"

#include <QtCore/QStringList>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace qplc {

namespace {

constexpr int mostNamesShown = 4;

const char *spaceName(ModbusRegister::Space space)
{
    constexpr const char *names[] = {"coil", "discrete input", "input register", "holding register"};
    return names[space];
}

QString exceptionText(ModbusException exception)
{
    switch (exception) {
    case ModbusException::UnknownFunction:
        return QStringLiteral("it does not know this function (exception 1); its manual tells which of coils, discrete "
                              "inputs, input and holding registers it has, and write-single = no may help");
    case ModbusException::UnknownAddress:
        return QStringLiteral(
            "it does not have all of these addresses (exception 2); they count from 0 here, what a manual "
            "calls 40101 is \"holding 100\"");
    case ModbusException::RefusedValue:
        return QStringLiteral("it refuses the value (exception 3); look at type, factor, word-order and byte-order");
    case ModbusException::DeviceFailure:
        return QStringLiteral("it has failed (exception 4); look at the display or the log of the device");
    case ModbusException::Acknowledge:
    case ModbusException::Busy:
        return QStringLiteral("it has been busy for too long (exceptions 5 and 6); a longer interval may help");
    case ModbusException::NoPath:
    case ModbusException::NoAnswerBehindGateway:
        return QStringLiteral("the gateway gets no answer from this unit (exceptions 10 and 11); look at unit, power "
                              "and wires behind the gateway");
    default:
        return QStringLiteral("it answers with exception %1").arg(int(exception));
    }
}

/// "holding registers 100 ... 103 (speed, torque) of unit 1"
QString requestText(const ModbusRequest &request, QStringList names)
{
    if (names.size() > mostNamesShown)
        names = names.mid(0, mostNamesShown) << QStringLiteral("...");
    const QString last = QStringLiteral("s %1 ... %2").arg(request.first).arg(request.first + request.count - 1);
    return QStringLiteral("%1%2 (%3) of unit %4")
        .arg(QLatin1String(spaceName(request.space)),
             request.count == 1 ? QStringLiteral(" %1").arg(request.first) : last, names.join(QStringLiteral(", ")))
        .arg(request.unit);
}

/// Bits and registers of the units behind one connection or one serial line, named by the
/// configuration: docs/hardware/modbus.md.
///
/// A bad answer is asked for again. Each unit is lost and found by itself; the device as a whole is
/// lost with the connection or line, or with all of its units.
class ModbusDriver final : public QPlcDriver
{
public:
    ModbusDriver()
        : QPlcDriver(OwnPace)
        , m_buffer(ModbusRequest::MostBitsRead)
    {
    }

private:
    struct Entry
    {
        QString name;
        ModbusRegister place;
        std::unique_ptr<QPlcReadChannel> reading;  // once the configuration has asked for it
        std::unique_ptr<QPlcWriteChannel> writing;
        std::vector<quint16> written;  // what the device has; empty: not known
    };
    enum WriteWhen : int { EveryTime, OnChange };
    struct Unit
    {
        quint8 number = 1;
        DeviceHealth health;
        QString fault;            // of the last request that failed
        bool isLost = false;      // as told
        bool isAsked = false;     // in this turn
        bool hasFailed = false;   // in this turn
        bool hasRefused = false;  // in this turn: it does not do what it is asked for
        std::unique_ptr<QPlcReadChannel> online;
        std::unique_ptr<QPlcReadChannel> errors;
    };

    void configure(QPlcDriverSettings &settings) override
    {
        m_device = settings.text(QStringLiteral("device"));
        m_link = makeModbusLink(settings);
        if (m_device.startsWith(QLatin1String("rtu:")))
            settings.claim(QStringLiteral("device"), QStringLiteral("serial line ") + m_device.mid(4));
        m_retries = int(
            settings.integer(QStringLiteral("retries"), DeviceHealth::DefaultRetries, 0, DeviceHealth::MostRetries));
        m_gap = int(settings.integer(QStringLiteral("gap"), 0, 0, ModbusRequest::MostBitsRead));
        m_isSingleAllowed = settings.truth(QStringLiteral("write-single"), true);
        m_writeWhen = settings.choice(QStringLiteral("write"), {QStringLiteral("always"), QStringLiteral("on-change")});
        configureRegisters(settings);
    }

    QPlcChannel *channel(const QString &name, QPlcChannel::Direction direction, QString *error) override
    {
        if (direction == QPlcChannel::Read && name.startsWith(QLatin1Char('@')))
            return ownChannel(name);
        Entry *found = entry(name);
        if (!found)
            return nullptr;
        if (direction == QPlcChannel::Write)
            return writeChannel(found, error);
        if (!found->reading)
            found->reading = std::make_unique<QPlcReadChannel>(this, name);
        return found->reading.get();
    }

    QStringList channelNames(QPlcChannel::Direction direction) const override
    {
        QStringList names;
        for (const Entry &entry : m_entries) {
            if (direction == QPlcChannel::Read || entry.place.isWritable())
                names << entry.name;
        }
        if (direction == QPlcChannel::Read) {
            names << QStringLiteral("@errors");
            for (const auto &[number, unit] : m_units)
                names << QStringLiteral("@errors.%1").arg(number) << QStringLiteral("@online.%1").arg(number);
        }
        return names;
    }

    bool open() override
    {
        planReading();
        for (auto &[number, unit] : m_units) {
            unit.health.reset();
            unit.isLost = unit.isAsked = unit.hasFailed = unit.hasRefused = false;
        }
        for (Entry &entry : m_entries)
            entry.written.clear();
        setDelivered(false);
        return m_link->open() || fail(QStringLiteral("%1: %2").arg(m_device, m_link->errorText()));
    }

    void close() override { m_link->close(); }

    bool read() override
    {
        for (const ModbusBlock &block : m_readBlocks) {
            if (!readBlock(block))
                return false;
        }
        for (auto &[number, unit] : m_units)
            judge(&unit);
        tellErrors();
        return isAnyoneThere();
    }

    /// Begins a turn.
    bool write() override
    {
        for (auto &[number, unit] : m_units)
            unit.isAsked = unit.hasFailed = unit.hasRefused = false;
        collectWrites();
        std::vector<ModbusBlock> later;
        for (const ModbusBlock &block : planToWrite(m_places)) {
            if (!writeBlock(block, &later))
                return false;
        }
        for (const ModbusBlock &block : later) {
            if (!writeBlock(block, nullptr))
                return false;
        }
        setDelivered(findUnwritten() == nullptr);
        return true;
    }

    QString undeliveredText() const override
    {
        QStringList texts;
        for (const auto &[number, unit] : m_units) {
            const Entry *entry = findUnwritten(number);
            if (entry && unit.fault.isEmpty())
                texts << QStringLiteral("unit %1 has no value for '%2'; give it a finite safe value")
                             .arg(number)
                             .arg(entry->name);
            else if (entry)
                texts << unit.fault;
        }
        return texts.join(QStringLiteral("; "));
    }

    void configureRegisters(QPlcDriverSettings &settings)
    {
        ModbusRegister defaults;
        const bool isSerial = m_device.startsWith(QLatin1String("rtu:"));
        defaults.unit = quint8(settings.integer(QStringLiteral("unit"), 1, isSerial ? 1 : 0, isSerial ? 247 : 255));
        const QStringList orders{QStringLiteral("big"), QStringLiteral("little")};
        defaults.isLowWordFirst = settings.choice(QStringLiteral("word-order"), orders) == 1;
        defaults.isLowByteFirst = settings.choice(QStringLiteral("byte-order"), orders) == 1;
        const QString prefix = QStringLiteral("register.");
        const QStringList names = settings.namesBehind(prefix);
        for (const QString &name : names) {
            Entry entry;
            entry.name = name;
            QString error;
            if (!ModbusRegister::parse(settings.text(prefix + name), defaults, &entry.place, &error)) {
                settings.addError(prefix + name, error);
                continue;
            }
            if (isSerial && (entry.place.unit < 1 || entry.place.unit > 247)) {
                settings.addError(prefix + name,
                                  QStringLiteral("a serial line has no unit %1 that answers; use a unit of 1 ... 247")
                                      .arg(entry.place.unit));
                continue;
            }
            m_units[entry.place.unit].number = entry.place.unit;
            m_entries.push_back(std::move(entry));
        }
        if (names.isEmpty())
            settings.addError(QString(),
                              QStringLiteral("no register is named; \"register.speed = holding 100, int16\" is one"));
    }

    Entry *entry(const QString &name)
    {
        const auto found
            = std::find_if(m_entries.begin(), m_entries.end(), [&name](const Entry &e) { return e.name == name; });
        return found == m_entries.end() ? nullptr : &*found;
    }

    /// @errors, @errors.UNIT, @online.UNIT
    QPlcChannel *ownChannel(const QString &name)
    {
        if (name == QLatin1String("@errors"))
            return made(&m_errors, name);
        for (auto &[number, unit] : m_units) {
            if (name == QStringLiteral("@errors.%1").arg(number))
                return made(&unit.errors, name);
            if (name == QStringLiteral("@online.%1").arg(number))
                return made(&unit.online, name);
        }
        return nullptr;
    }

    QPlcReadChannel *made(std::unique_ptr<QPlcReadChannel> *channel, const QString &name)
    {
        if (!*channel)
            *channel = std::make_unique<QPlcReadChannel>(this, name);
        return channel->get();
    }

    QPlcChannel *writeChannel(Entry *entry, QString *error)
    {
        if (!entry->place.isWritable()) {
            *error = QStringLiteral("'%1' can only be read: it is of the %2s")
                         .arg(entry->name, QLatin1String(spaceName(entry->place.space)));
            return nullptr;
        }
        for (const Entry &other : m_entries) {
            if (other.writing && &other != entry && overlap(other.place, entry->place)) {
                *error = QStringLiteral("'%1' and '%2' are the same place of the device; write one of them")
                             .arg(entry->name, other.name);
                return nullptr;
            }
        }
        if (!entry->writing)
            entry->writing = std::make_unique<QPlcWriteChannel>(this, entry->name);
        const RawNumber::Limits limits = entry->place.limits();
        entry->writing->setRange(limits.lowest, limits.highest);
        return entry->writing.get();
    }

    void planReading()
    {
        std::vector<ModbusRegister> places;
        m_toRead.clear();
        for (std::size_t i = 0; i < m_entries.size(); ++i) {
            if (m_entries[i].reading && m_entries[i].reading->isWired()) {
                m_toRead.push_back(i);
                places.push_back(m_entries[i].place);
            }
        }
        m_readBlocks = planToRead(places, m_gap);
    }

    /// \return false when the way to all units is gone
    bool readBlock(const ModbusBlock &block)
    {
        Unit &unit = m_units[block.request.unit];
        if (!isToBeAsked(unit))
            return true;
        if (!ask(&unit, unit.health.attempts(m_retries),
                 [&] { return m_link->read(block.request, m_buffer.data()); })) {
            QStringList names;
            for (std::size_t member : block.members)
                names << m_entries[m_toRead[member]].name;
            return noteFault(&unit, "read", block.request, names);
        }
        for (std::size_t member : block.members) {
            const Entry &entry = m_entries[m_toRead[member]];
            const double value = entry.place.decode(&m_buffer[entry.place.address - block.request.first]);
            if (std::isfinite(value))
                entry.reading->set(value);
            else
                entry.reading->invalidate();
        }
        return true;
    }

    /// Takes the values that are to be written now into m_toWrite, m_places and m_words.
    void collectWrites()
    {
        m_toWrite.clear();
        m_places.clear();
        m_words.clear();
        for (std::size_t i = 0; i < m_entries.size(); ++i) {
            const Entry &entry = m_entries[i];
            if (!entry.writing || !entry.writing->hasValue() || !std::isfinite(entry.writing->value()))
                continue;
            std::vector<quint16> words(std::size_t(entry.place.size()));
            entry.place.encode(entry.writing->value(), words.data());
            if (m_writeWhen == OnChange && words == entry.written)
                continue;
            m_toWrite.push_back(i);
            m_places.push_back(entry.place);
            m_words.push_back(std::move(words));
        }
    }

    /// \param later  gets the block if its unit has never answered and is silent: the others come
    /// first, and it is asked again after them. Null: that is now
    bool writeBlock(const ModbusBlock &block, std::vector<ModbusBlock> *later)
    {
        Unit &unit = m_units[block.request.unit];
        if (!isToBeAsked(unit))
            return true;
        const bool mayWait = later && m_units.size() > 1 && !unit.health.hasAnswered() && m_retries > 0;
        const auto isOfUnit = [&block](const ModbusBlock &one) { return one.request.unit == block.request.unit; };
        if (mayWait && std::any_of(later->begin(), later->end(), isOfUnit)) {
            later->push_back(block);
            return true;
        }
        ModbusRequest request = block.request;
        request.isSingle = m_isSingleAllowed && request.count == 1;
        const int attempts = mayWait ? 1 : later ? unit.health.attempts(m_retries) : m_retries;
        ModbusRequest reading;
        compose(block);
        const bool isComplete = keepOtherBits(block, &unit, attempts, &reading);
        if (!isComplete || !ask(&unit, attempts, [&] { return m_link->write(request, m_buffer.data()); })) {
            if (mayWait && m_link->isAnswerBad()) {
                later->push_back(block);
                return true;
            }
            QStringList names;
            for (std::size_t member : block.members)
                names << m_entries[m_toWrite[member]].name;
            return isComplete ? noteFault(&unit, "write", request, names) : noteFault(&unit, "read", reading, names);
        }
        for (std::size_t member : block.members)
            m_entries[m_toWrite[member]].written = m_words[member];
        return true;
    }

    /// The words of a block into m_buffer, and which of their bits it has into m_masks.
    void compose(const ModbusBlock &block)
    {
        std::fill_n(m_buffer.begin(), block.request.count, quint16(0));
        m_masks.assign(std::size_t(block.request.count), 0);
        for (std::size_t member : block.members) {
            const ModbusRegister &place = m_places[member];
            for (std::size_t i = 0; i < m_words[member].size(); ++i) {
                const std::size_t at = std::size_t(place.address - block.request.first) + i;
                m_buffer[at] = quint16(m_buffer[at] | m_words[member][i]);
                m_masks[at] = quint16(m_masks[at] | (place.isPart() ? place.mask() : 0xFFFF));
            }
        }
    }

    /// The other bits of registers of which a block has some stay as the device has them now.
    /// \param reading  the request that failed
    bool keepOtherBits(const ModbusBlock &block, Unit *unit, int attempts, ModbusRequest *reading)
    {
        for (std::size_t i = 0; i < m_masks.size(); ++i) {
            if (m_masks[i] == 0xFFFF)
                continue;
            quint16 word = 0;
            *reading = {block.request.unit, block.request.space, quint16(block.request.first + i), 1, false};
            if (!ask(unit, attempts, [&] { return m_link->read(*reading, &word); }))
                return false;
            m_buffer[i] = quint16(m_buffer[i] | (word & ~m_masks[i]));
        }
        return true;
    }

    /// \param number  of a unit; -1: of all
    /// \return a value that its unit has not confirmed as it is now; null if all are confirmed
    const Entry *findUnwritten(int number = -1) const
    {
        const auto isUnwritten = [&](const Entry &entry) {
            if (!entry.writing || !entry.writing->isWired() || (number >= 0 && entry.place.unit != number))
                return false;
            if (!entry.writing->hasValue() || !std::isfinite(entry.writing->value()))
                return true;
            std::vector<quint16> words(std::size_t(entry.place.size()));
            entry.place.encode(entry.writing->value(), words.data());
            return words != entry.written || m_units.at(entry.place.unit).hasFailed;
        };
        const auto found = std::find_if(m_entries.begin(), m_entries.end(), isUnwritten);
        return found == m_entries.end() ? nullptr : &*found;
    }

    // ---- units that fail ----

    bool isToBeAsked(const Unit &unit) const { return !unit.hasFailed && unit.health.isDue(now()); }

    template<typename Request>
    bool ask(Unit *unit, int attempts, Request request)
    {
        unit->isAsked = true;
        for (int left = attempts; left > 0; --left) {
            if (request())
                return true;
            unit->health.countError();
            if (!m_link->isAnswerBad())
                return false;
        }
        return false;
    }

    /// \return false when it is the fault of the way to all units
    bool noteFault(Unit *unit, const char *operation, const ModbusRequest &request, const QStringList &names)
    {
        const ModbusException exception = m_link->exception();
        const QString reason = exception == ModbusException::None ? m_link->errorText() : exceptionText(exception);
        unit->fault = QStringLiteral("%1: cannot %2 %3: %4")
                          .arg(m_device, QLatin1String(operation), requestText(request, names), reason);
        unit->hasFailed = true;
        if (m_link->isAnswerBad())
            return true;
        if (exception == ModbusException::None)
            return fail(unit->fault);
        const bool isBusy = exception == ModbusException::Busy || exception == ModbusException::Acknowledge;
        unit->hasRefused = !isBusy;
        if (isBusy && !unit->health.hasAnswered())
            unit->health.succeed(now());  // it is there
        return true;
    }

    /// At the end of a turn: whether the unit is there.
    void judge(Unit *unit)
    {
        if (!unit->isAsked)
            return;
        const qint64 patience = timeout().count();
        if (!unit->hasFailed)
            unit->health.succeed(now());
        else if (unit->hasRefused)
            unit->health.giveUp(now());
        else
            unit->health.fail(now(), patience);
        const bool isLost = unit->health.isLost(now(), patience);
        if (isLost != unit->isLost)
            tellUnit(unit, isLost);
    }

    void tellUnit(Unit *unit, bool isLost)
    {
        unit->isLost = isLost;
        if (!isLost) {
            qCInfo(lcHardware).noquote() << QStringLiteral("%1: unit %2 answers again").arg(m_device).arg(unit->number);
            return;
        }
        for (Entry &entry : m_entries) {
            if (entry.place.unit != unit->number)
                continue;
            entry.written.clear();
            if (entry.reading)
                entry.reading->invalidate();
        }
        if (m_units.size() > 1)
            qCWarning(lcHardware).noquote() << unit->fault << "(unit is lost; trying again)";
    }

    void tellErrors()
    {
        quint64 sum = 0;
        for (const auto &[number, unit] : m_units) {
            sum += unit.health.errors();
            if (unit.errors)
                unit.errors->set(double(unit.health.errors()));
            if (unit.online)
                unit.online->set(unit.health.hasAnswered() && !unit.isLost ? 1.0 : 0.0);
        }
        if (m_errors)
            m_errors->set(double(sum));
    }

    /// Whether a unit answers, or none has been asked yet.
    bool isAnyoneThere()
    {
        const Unit *lost = nullptr;
        for (const auto &[number, unit] : m_units) {
            if (unit.isLost)
                lost = &unit;
            else if (unit.health.hasAnswered())
                return true;
        }
        return !lost || fail(lost->fault);
    }

    QString m_device;
    std::unique_ptr<ModbusLink> m_link;
    std::vector<Entry> m_entries;
    int m_gap = 0;
    bool m_isSingleAllowed = true;
    int m_writeWhen = EveryTime;

    std::vector<std::size_t> m_toRead;  // indices of entries
    std::vector<ModbusBlock> m_readBlocks;
    std::vector<quint16> m_buffer;  // of a request

    std::vector<std::size_t> m_toWrite;
    std::vector<ModbusRegister> m_places;
    std::vector<std::vector<quint16>> m_words;
    std::vector<quint16> m_masks;  // of the words of a block

    std::map<quint8, Unit> m_units;
    std::unique_ptr<QPlcReadChannel> m_errors;  // of all of them
    int m_retries = DeviceHealth::DefaultRetries;
};

}  // namespace

std::unique_ptr<QPlcDriver> createModbusDriver()
{
    return std::make_unique<ModbusDriver>();
}

}  // namespace qplc
