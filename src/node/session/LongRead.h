// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/ControlFrame.h"
#include "protocol/messages/Registration.h"

#include <memory>

namespace qplc {

/// A long message of a connection, which another thread reads: into a QPlcMessage, and a Register
/// into its struct.
struct LongRead
{
    enum Stage : quint8 {
        Begun,
        Ended,  // it may be carried out, or is no message
        Given   // it is being carried out; its memory goes back when that has ended
    };

    UnreadControlFrame frame;
    Stage stage = Begun;  // of the owner alone
    ControlFrameReader::Error error = ControlFrameReader::NoError;
    QString errorText;
    QPlcMessage message;
    std::shared_ptr<const messages::Register> registration;  // null: the message is no usable Register
    QString fault;                                           // of a Register that is not usable

    /// On the other thread.
    void read();
};

}  // namespace qplc
