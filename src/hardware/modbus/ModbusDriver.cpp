// SPDX-License-Identifier: Apache-2.0
#include "ModbusDriver.h"

#include "ModbusDevice.h"
#include "QPlcDriverSettings.h"

#include <QtCore/QStringList>

#include <algorithm>
#include <cmath>

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

}  // namespace

ModbusDriver::ModbusDriver()
    : QPlcDriver(OwnPace)
    , m_buffer(ModbusRequest::MostBitsRead)
{
}

ModbusDriver::~ModbusDriver() = default;

QString ModbusDriver::description()
{
    return QStringLiteral("registers and coils of a Modbus device, over TCP or a serial line (RTU)");
}

void ModbusDriver::configure(QPlcDriverSettings &settings)
{
    m_device = settings.text(QStringLiteral("device"));
    m_link = makeModbusLink(settings);
    m_gap = int(settings.integer(QStringLiteral("gap"), 0, 0, ModbusRequest::MostBitsRead));
    m_isSingleAllowed = settings.truth(QStringLiteral("write-single"), true);
    m_writeWhen = settings.choice(QStringLiteral("write"), {QStringLiteral("always"), QStringLiteral("on-change")});
    configureRegisters(settings);
}

void ModbusDriver::configureRegisters(QPlcDriverSettings &settings)
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

ModbusDriver::Entry *ModbusDriver::entry(const QString &name)
{
    const auto found
        = std::find_if(m_entries.begin(), m_entries.end(), [&name](const Entry &e) { return e.name == name; });
    return found == m_entries.end() ? nullptr : &*found;
}

QPlcChannel *ModbusDriver::channel(const QString &name, QPlcChannel::Direction direction, QString *error)
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

QPlcChannel *ModbusDriver::writeChannel(Entry *entry, QString *error)
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

QStringList ModbusDriver::channelNames(QPlcChannel::Direction direction) const
{
    QStringList names;
    for (const Entry &entry : m_entries) {
        if (direction == QPlcChannel::Read || entry.place.isWritable())
            names << entry.name;
    }
    return names;
}

bool ModbusDriver::open()
{
    planReading();
    m_busySince = -1;
    m_wasBusy = false;
    for (Entry &entry : m_entries)
        entry.written.clear();
    return m_link->open() || fail(QStringLiteral("%1: %2").arg(m_device, m_link->errorText()));
}

void ModbusDriver::close()
{
    m_link->close();
}

void ModbusDriver::planReading()
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

bool ModbusDriver::read()
{
    if (!std::all_of(m_readBlocks.begin(), m_readBlocks.end(), [this](const ModbusBlock &b) { return readBlock(b); }))
        return false;
    if (!m_wasBusy)
        m_busySince = -1;
    m_wasBusy = false;
    return true;
}

bool ModbusDriver::readBlock(const ModbusBlock &block)
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

bool ModbusDriver::write()
{
    collectWrites();
    const std::vector<ModbusBlock> blocks = planToWrite(m_places);
    return std::all_of(blocks.begin(), blocks.end(), [this](const ModbusBlock &block) { return writeBlock(block); });
}

void ModbusDriver::collectWrites()
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

bool ModbusDriver::writeBlock(const ModbusBlock &block)
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

bool ModbusDriver::isTolerable(ModbusException exception)
{
    if (exception != ModbusException::Busy && exception != ModbusException::Acknowledge)
        return false;
    m_wasBusy = true;
    if (m_busySince < 0)
        m_busySince = now();
    return now() - m_busySince <= timeout().count();
}

bool ModbusDriver::failRequest(const char *operation, const ModbusRequest &request, const QStringList &names)
{
    const QString reason
        = m_link->exception() == ModbusException::None ? m_link->errorText() : exceptionText(m_link->exception());
    return fail(QStringLiteral("%1: cannot %2 %3: %4")
                    .arg(m_device, QLatin1String(operation), requestText(request, names), reason));
}

}  // namespace qplc
