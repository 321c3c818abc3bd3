// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcQuality.h"
#include "QPlcRecordingGlobal.h"
#include "QPlcValue.h"

#include <QtCore/QString>
#include <QtCore/QStringList>

#include <memory>

class QPlcRecording;

/// The cycles of a recording, one after the other, with the signals that are wanted.
///
/// \code
/// QPlcRecording recording;
/// recording.open("/var/lib/qtplc/recordings/");
/// QPlcRecordedRows rows(recording, {"tetherForce", "phase"}, recording.begin(), recording.end());
/// while (rows.next())
///     qInfo("%llu: %g N, %s", rows.cycle(), rows.number(0), qPrintable(rows.value(1).toString()));
/// if (rows.damages() > 0)
///     qWarning("%d places of the recording are damaged", rows.damages());
/// \endcode
///
/// Only the chunks of these times are read, one at a time.
///
/// \threadsafe no: one thread, that of the recording
///
/// \ingroup recording
class QTPLC_RECORDING_EXPORT QPlcRecordedRows
{
public:
    /// Stands before the first cycle: next() goes there.
    /// \param recording  is open, outlives this object, and is not opened anew meanwhile
    /// \param names  of the signals, which are the columns, from 0
    /// \param begin  first time [ns]
    /// \param end  last time [ns]
    QPlcRecordedRows(QPlcRecording &recording, const QStringList &names, qint64 begin, qint64 end);
    /// Closes the file that is being read.
    ~QPlcRecordedRows();

    /// Whether the recording is open and has all signals. Otherwise there is no row.
    bool isValid() const;
    /// Returns which signal is not there.
    QString errorString() const;

    /// Goes to the next cycle. \return false behind the last one
    bool next();
    /// Returns the nominal time of the cycle [ns].
    qint64 time() const;
    /// Returns the wall clock when the cycle has ended [ns since 1970]; in simulations time().
    qint64 wallTime() const;
    /// Returns the number of the cycle.
    quint64 cycle() const;
    /// Returns how many cycles the master has skipped before this one, because it was late.
    quint64 skipped() const;
    /// Returns how late the master was with this cycle [ns].
    qint64 lateness() const;

    /// Whether the file of this cycle has the signal.
    bool hasValue(int column) const;
    /// Returns a number of the signal.
    /// \param column  of the signal, \param element  of an array, from 0
    /// \return NaN for a text, or without a value
    double number(int column, int element = 0) const;
    /// Returns the value with its type, also texts and integers of 64 bits.
    /// \param column  of the signal
    /// \return an invalid value without one
    QPlcValue value(int column) const;
    /// Returns the quality of the signal in this cycle; Invalid without a value.
    /// \param column  of the signal
    QPlcQuality quality(int column) const;

    /// Returns how many damaged places were left out so far.
    int damages() const;

private:
    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};
