// SPDX-License-Identifier: Apache-2.0
#include "ModbusDevice.h"
#include "ModbusPlan.h"
#include "QPlcDriverSettings.h"
#include "QPlcReadChannel.h"
#include "QPlcWriteChannel.h"
#include "hardware/Drivers.h"

#include <QtCore/QStringList>

#include <algorithm>
#include <cmath>
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
        return QStringLiteral("it refuses the value (exception 3); look at type, factor and word-order");
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

    void configure(QPlcDriverSettings &settings) override
    {
        m_device = settings.text(QStringLiteral("device"));
        m_link = makeModbusLink(settings);
        m_gap = int(settings.integer(QStringLiteral("gap"), 0, 0, ModbusRequest::MostBitsRead));
        m_isSingleAllowed = settings.truth(QStringLiteral("write-single"), true);
        m_writeWhen = settings.choice(QStringLiteral("write"), {QStringLiteral("always"), QStringLiteral("on-change")});
        configureRegisters(settings);
    }

    QPlcChannel *channel(const QString &name, QPlcChannel::Direction direction, QString *error) override
    {
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
        return names;
    }

    bool open() override
    {
        planReading();
        m_busySince = -1;
        m_wasBusy = false;
        for (Entry &entry : m_entries)
            entry.written.clear();
        return m_link->open() || fail(QStringLiteral("%1: %2").arg(m_device, m_link->errorText()));
    }

    void close() override { m_link->close(); }

    bool read() override
    {
        if (!std::all_of(m_readBlocks.begin(), m_readBlocks.end(),
                         [this](const ModbusBlock &b) { return readBlock(b); }))
            return false;
        if (!m_wasBusy)
            m_busySince = -1;
        m_wasBusy = false;
        return true;
    }

    bool write() override
    {
        collectWrites();
        const std::vector<ModbusBlock> blocks = planToWrite(m_places);
        return std::all_of(blocks.begin(), blocks.end(),
                           [this](const ModbusBlock &block) { return writeBlock(block); });
    }

    void configureRegisters(QPlcDriverSettings &settings)
    {
        ModbusRegister defaults;
        const bool isSerial = m_device.startsWith(QLatin1String("rtu:"));
        defaults.unit = quint8(settings.integer(QStringLiteral("unit"), 1, isSerial ? 1 : 0, isSerial ? 247 : 255));
        defaults.isLowWordFirst
            = settings.choice(QStringLiteral("word-order"), {QStringLiteral("big"), QStringLiteral("little")}) == 1;
        const QString prefix = QStringLiteral("register.");
        const QStringList names = settings.namesBehind(prefix);
        for (const QString &name : names) {
            Entry entry;
            entry.name = name;
            QString error;
            if (ModbusRegister::parse(settings.text(prefix + name), defaults, &entry.place, &error))
                m_entries.push_back(std::move(entry));
            else
                settings.addError(prefix + name, error);
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

    QPlcChannel *writeChannel(Entry *entry, QString *error)
    {
        if (!entry->place.isWritable()) {
            *error = entry->place.isOfBits() || entry->place.type != ModbusRegister::Bit
                ? QStringLiteral("'%1' can only be read: it is of the %2s")
                      .arg(entry->name, QLatin1String(spaceName(entry->place.space)))
                : QStringLiteral("'%1' is a bit of a register, which can only be read; write the whole register")
                      .arg(entry->name);
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

    bool readBlock(const ModbusBlock &block)
    {
        if (!m_link->read(block.request, m_buffer.data())) {
            if (isTolerable(m_link->exception()))
                return true;
            QStringList names;
            for (std::size_t member : block.members)
                names << m_entries[m_toRead[member]].name;
            return failRequest("read", block.request, names);
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

    bool writeBlock(const ModbusBlock &block)
    {
        ModbusRequest request = block.request;
        request.isSingle = m_isSingleAllowed && request.count == 1;
        for (std::size_t member : block.members) {
            const auto place = m_buffer.begin() + (m_places[member].address - request.first);
            std::copy(m_words[member].begin(), m_words[member].end(), place);
        }
        if (!m_link->write(request, m_buffer.data())) {
            if (isTolerable(m_link->exception()))
                return true;
            QStringList names;
            for (std::size_t member : block.members)
                names << m_entries[m_toWrite[member]].name;
            return failRequest("write", request, names);
        }
        for (std::size_t member : block.members)
            m_entries[m_toWrite[member]].written = m_words[member];
        return true;
    }

    /// Whether to go on without this answer: a device may be busy for a while.
    bool isTolerable(ModbusException exception)
    {
        if (exception != ModbusException::Busy && exception != ModbusException::Acknowledge)
            return false;
        m_wasBusy = true;
        if (m_busySince < 0)
            m_busySince = now();
        return now() - m_busySince <= timeout().count();
    }

    bool failRequest(const char *operation, const ModbusRequest &request, const QStringList &names)
    {
        const QString reason
            = m_link->exception() == ModbusException::None ? m_link->errorText() : exceptionText(m_link->exception());
        return fail(QStringLiteral("%1: cannot %2 %3: %4")
                        .arg(m_device, QLatin1String(operation), requestText(request, names), reason));
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

    qint64 m_busySince = -1;  // [ns]; -1: no request was refused for this
    bool m_wasBusy = false;   // in this turn
};

}  // namespace

std::unique_ptr<QPlcDriver> createModbusDriver()
{
    return std::make_unique<ModbusDriver>();
}

}  // namespace qplc
