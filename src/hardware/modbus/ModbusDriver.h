// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ModbusPlan.h"
#include "QPlcDriver.h"
#include "QPlcReadChannel.h"
#include "QPlcWriteChannel.h"

#include <memory>
#include <vector>

namespace qplc {

/// Bits and registers of the units behind one connection or one serial line, named by the
/// configuration: docs/hardware/modbus.md.
class ModbusDriver final : public QPlcDriver
{
public:
    ModbusDriver();
    ~ModbusDriver() override;

    static QString description();

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

    void configure(QPlcDriverSettings &settings) override;
    QPlcChannel *channel(const QString &name, QPlcChannel::Direction direction, QString *error) override;
    QStringList channelNames(QPlcChannel::Direction direction) const override;
    bool open() override;
    void close() override;
    bool read() override;
    bool write() override;

    void configureRegisters(QPlcDriverSettings &settings);
    Entry *entry(const QString &name);
    QPlcChannel *writeChannel(Entry *entry, QString *error);
    void planReading();
    bool readBlock(const ModbusBlock &block);
    /// Takes the values that are to be written now into m_toWrite, m_places and m_words.
    void collectWrites();
    bool writeBlock(const ModbusBlock &block);
    /// Whether to go on without this answer: a device may be busy for a while.
    bool isTolerable(ModbusException exception);
    bool failRequest(const char *operation, const ModbusRequest &request, const QStringList &names);

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

}  // namespace qplc
