// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SdoFrame.h"

namespace qplc {

/// Reads or writes one object of a device by SDO (CiA 301): the client's side, frame by frame,
/// without bus and clock. Up to four bytes travel in the first frame (expedited), more in segments.
///
/// ```cpp
/// SdoTransfer transfer = SdoTransfer::read({0x1018, 1});
/// send(transfer.request());
/// while (transfer.state() == SdoTransfer::Running && receive(&response)) {
///     if (transfer.take(response) && transfer.hasRequest())
///         send(transfer.request());
/// }
/// ```
class SdoTransfer
{
public:
    using Data = SdoFrame::Data;
    static constexpr int MaximumSize = 64 << 10;  // [byte] of a value

    enum State : quint8 {
        Running,
        Done,
        Aborted  ///< by the device, or by us because its answer makes no sense: abortCode()
    };

    /// What an abort code means; "unknown reason" for one that CiA 301 does not have.
    static QString abortText(quint32 code);

    static SdoTransfer read(ObjectAddress address);
    /// \param value  at most MaximumSize bytes
    static SdoTransfer write(ObjectAddress address, const QByteArray &value);

    /// The next frame to send.
    const Data &request() const { return m_request; }
    /// Whether request() is still to be sent: after the begin, after take(), and after the client
    /// has aborted.
    bool hasRequest() const { return m_hasRequest; }
    /// request() was sent.
    void sent() { m_hasRequest = false; }

    /// Takes a frame of the device. \return false when it does not belong to this transfer
    bool take(const Data &response);
    /// Ends the transfer with an abort of the client.
    void abort(quint32 code);

    State state() const { return m_state; }
    bool isWrite() const { return m_isWrite; }
    ObjectAddress address() const { return m_address; }
    quint32 abortCode() const { return m_abortCode; }
    /// What was read, when state() is Done.
    const QByteArray &value() const { return m_value; }

private:
    SdoTransfer(ObjectAddress address, bool isWrite, const QByteArray &value);
    void ask(quint8 command, quint32 rest = 0);
    void takeFirstOfRead(const Data &response);
    void takeSegmentOfRead(const Data &response);
    void takeAnswerToWrite(const Data &response);
    void sendSegment();
    void askForSegment();
    bool isAddressed(const Data &response) const { return SdoFrame::addressOf(response) == m_address; }

    ObjectAddress m_address;
    bool m_isWrite;
    State m_state = Running;
    bool m_isInSegments = false;
    bool m_hasRequest = true;
    quint8 m_toggle = 0;  // 0 or 0x10, of the segment that is under way
    int m_size = -1;      // [byte] that the device has promised; -1: it has not
    int m_position = 0;   // behind the segment that is under way, of a write
    quint32 m_abortCode = 0;
    QByteArray m_value;
    Data m_request{};
};

}  // namespace qplc
