// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcAbstractSocket.h"
#include "QPlcSecurity.h"
#include "QPlcUnderlyingProtocol.h"

/// The control connection of a slave (or a tool) to its master.
class QTPLC_EXPORT QPlcMasterSocket : public QPlcAbstractSocket
{
    Q_OBJECT
public:
    explicit QPlcMasterSocket(QObject *parent = nullptr);
    ~QPlcMasterSocket() override;

    /// How the two ends know each other; QPlcSecurity::current() unless set. Takes effect with connectToMaster().
    void setSecurity(const QPlcSecurity &security);
    /// Begins to connect; connected() or errorOccurred() follows. With security, connected() comes when the handshake has succeeded, which may take 5 s at most.
    void connectToMaster(const QPlcUnderlyingProtocol &master);

protected:
    QString securityErrorText() const override;

private:
    void connectSecurely(const QPlcUnderlyingProtocol &master);

    struct Private;
    std::unique_ptr<Private> d;
};
