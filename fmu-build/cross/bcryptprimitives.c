/* Replaces Windows' bcryptprimitives.dll under wine older than 9.0, which lacks it. Rust's standard library uses it for the
   seeds of its hash tables. It is only for tests under wine: Windows has its own, and the FMU contains none. */
#include <windows.h>

BOOLEAN NTAPI SystemFunction036(PVOID data, ULONG length); /* RtlGenRandom */

__declspec(dllexport) BOOL WINAPI ProcessPrng(PBYTE data, SIZE_T length)
{
    return SystemFunction036(data, (ULONG)length);
}
