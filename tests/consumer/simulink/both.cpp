// SPDX-License-Identifier: Apache-2.0
#include "pendulum.h"
#include "second.h"

int main()
{
    return make_pendulum()->name() == make_second()->name();
}
