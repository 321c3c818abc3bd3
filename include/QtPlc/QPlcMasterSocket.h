// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcAbstractSocket.h"
#include "QPlcUnderlyingProtocol.h"

/// The control connection of a slave (or a tool) to its master.
class QTPLC_EXPORT QPlcMasterSocket : public QPlcAbstractSocket
{
    Q_OBJECT
public:
    explicit QPlcMasterSocket(QObject *parent = nullptr);

    /// Begins to connect; connected() or errorOccurred() follows.
    void connectToMaster(const QPlcUnderlyingProtocol &master);
};
