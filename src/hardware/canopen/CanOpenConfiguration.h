// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Cia402Axis.h"
#include "EdsFile.h"
#include "Pdo.h"

#include <QtCore/QStringList>

#include <chrono>

class QPlcDriverSettings;

namespace qplc {

/// What a device has to be (object 1018h); 0: any.
struct CanOpenIdentity
{
    quint32 vendor = 0;
    quint32 product = 0;
    quint32 revision = 0;
    quint32 serial = 0;
};

/// A value that a device gets before it is started.
struct CanOpenSetting
{
    ObjectAddress address;
    QByteArray value;
};

/// Who sends the SYNC of a bus.
enum class SyncSource : quint8 { Nobody, EveryCycle, FromOthers };

/// The keys of a CanOpenDriver, which describes them.
class CanOpenConfiguration
{
public:
    /// What is wrong is told to \a settings.
    void read(QPlcDriverSettings &settings);
    /// \return [bit/s]; 0: not said
    static int readBitRate(const QString &device, QPlcDriverSettings &settings);

    std::chrono::nanoseconds timeout{100'000'000};  // of the driver; before read()
    QString device;
    int bitRate = 0;  // [bit/s]; 0: not said
    int node = 0;     // 0: none, the section only sends SYNC
    SyncSource sync = SyncSource::Nobody;
    std::chrono::milliseconds heartbeat{100};          // of the device and of the master
    int master = 127;                                  // node id of the master in its heartbeats; 0: it sends none
    std::chrono::nanoseconds answerTime{200'000'000};  // in which the device answers an SDO
    CanOpenIdentity identity;
    QVector<CanOpenSetting> startValues;
    QVector<Pdo> pdos;
    bool isAxis = false;
    AxisMode mode = AxisMode::SyncVelocity;
    AxisLimits limits;

    /// For how long the values of a PDO of the device are fresh. \return 0: as long as the device
    /// lives
    std::chrono::nanoseconds freshTime(const Pdo &pdo) const;
    /// The PDO and the entry in it that have an object. \param isTransmit  the device sends it
    /// \return false when there is none
    bool find(const QString &text, bool isTransmit, int *pdo, int *entry) const;

private:
    QString placeOf(int id) const;
    void readNode(QPlcDriverSettings &settings);
    void readEds(QPlcDriverSettings &settings);
    void readIdentity(QPlcDriverSettings &settings);
    void readAxis(QPlcDriverSettings &settings);
    void readSettings(QPlcDriverSettings &settings);
    void readPdos(bool isTransmit, QPlcDriverSettings &settings);
    bool readPdo(const QStringList &words, Pdo *pdo, QString *error) const;
    bool readPdoWord(const QString &word, Pdo *pdo, QString *error) const;
    bool readEntry(const QString &word, PdoEntry *entry, QString *error) const;
    bool readSetting(const QString &text, CanOpenSetting *setting, QString *error) const;
    void addPdosOfFile(bool isTransmit, QPlcDriverSettings &settings);
    static QString problemOfFile(const Pdo &pdo);
    void addPdosOfAxis();
    void addPdo(int number, bool isTransmit, std::initializer_list<ObjectAddress> objects);
    void checkIds(QPlcDriverSettings &settings);
    void checkWriters(QPlcDriverSettings &settings);
    void checkTimes(QPlcDriverSettings &settings);
    void checkAxis(QPlcDriverSettings &settings);
    const CanOpenObject *objectOf(const QString &text) const;
    PdoEntry entryOf(ObjectAddress address, int bits) const;
    QStringList objectNames() const;

    EdsFile m_file;
};

}  // namespace qplc
