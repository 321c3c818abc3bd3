// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcRecording.h"
#include "Recording.h"

struct QPlcRecording::Private
{
    qplc::Recording recording;
    bool isOpen = false;
    QString error;
    int damages = 0;
};
