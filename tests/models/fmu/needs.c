// SPDX-License-Identifier: Apache-2.0
// A library that an FMU needs, and that is not in it.
int fromAnotherLibrary(void)
{
    return 1;
}
