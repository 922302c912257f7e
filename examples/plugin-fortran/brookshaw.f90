! SPDX-License-Identifier: 0BSD
! Heat conduction in Fortran: Brookshaw's difference form (Brookshaw 1985; Campbell 1989, Eq. 63) with the cubic spline, which
! looks for its neighbours itself, as a code of one's own would. sphverify has the same as conduction/brookshaw: rates must
! agree to round-off.
!
!   gfortran -O2 -fPIC -shared sphverify_plugin.f90 brookshaw.f90 -o libbrookshaw.so
!   sphverify evaluate state.json --plugin ./libbrookshaw.so
function sphverify_plugin_abi() bind(C) result(version)
  use sphverify_plugin
  integer(c_int) :: version
  version = sphverify_plugin_version
end function

subroutine sphverify_plugin_describe(d) bind(C)
  use sphverify_plugin
  type(description), intent(inout) :: d
  call put("brookshaw-in-fortran", d%name)
  call put("Brookshaw's difference form, in Fortran", d%title)
  call put("Brookshaw 1985; Campbell 1989, Eq. 63", d%source)
  call put("de_i/dt = sum_j m_j (K_i+K_j)/(rho_i rho_j) (T_i-T_j) (r_ij.grad_i W_ij)/r_ij^2 + (K_i+K_B)/rho_i (T_B-T_i)/d_i A_i", &
           d%equation)
  d%rate = conduction_heating
  d%reads = reads_density + reads_temperature + reads_conductivity
  d%reads_at_walls = reads_temperature + reads_conductivity + reads_flux
  d%conserves = conserves_energy
  d%thread_safe = 1
end subroutine

! (dW/dr)/r of the cubic spline (Monaghan & Lattanzio 1985)
pure function slope(r, h, dimension) result(value)
  use sphverify_plugin
  real(c_double), intent(in) :: r, h
  integer, intent(in) :: dimension
  real(c_double) :: value, q
  real(c_double), parameter :: pi = acos(-1.0_c_double)
  real(c_double), parameter :: sigma(3) = [2.0_c_double/3, 10/(7*pi), 1/pi]
  q = r/h
  value = 0
  if (q < 1) then
    value = -3 + 2.25_c_double*q
  else if (q < 2) then
    value = -0.75_c_double*(2 - q)**2/q
  end if
  value = value*sigma(dimension)/h**(dimension + 2)
end function

function sphverify_plugin_rates(s, rates) bind(C) result(status)
  use sphverify_plugin
  implicit none
  type(state_type), intent(in) :: s
  type(rates_type), intent(inout) :: rates
  integer(c_int) :: status
  interface
    pure function slope(r, h, dimension) result(value)
      use sphverify_plugin
      real(c_double), intent(in) :: r, h
      integer, intent(in) :: dimension
      real(c_double) :: value
    end function
  end interface
  real(c_double), pointer :: x(:), mass(:), rho(:), T(:), K(:), heating(:), of_wall(:), distance(:), weight(:), T_B(:), K_B(:), F(:)
  real(c_double), allocatable :: places(:, :)
  integer(c_int32_t), pointer :: particle(:)
  type(wall_type), pointer :: walls(:)
  type(c_ptr), pointer :: wall_rates(:, :)
  real(c_double) :: r_ij(3), r
  integer :: n, i, j, axis, w, c, dims

  status = 1
  ! This code has one kernel, one smoothing length for all particles, and boxes along the axes of space.
  if (c_associated(s%smoothing_lengths) .or. text_of(s%kernel) /= "cubic-spline") return
  do axis = 1, s%dimension
    if (s%axes((axis - 1)*s%dimension + axis) /= 1) return
  end do
  n = int(s%count)
  dims = s%dimension
  allocate (places(dims, n))
  do axis = 1, dims
    call c_f_pointer(s%position(axis), x, [n])
    places(axis, :) = x
  end do
  call c_f_pointer(s%mass, mass, [n])
  call c_f_pointer(s%density, rho, [n])
  call c_f_pointer(s%temperature, T, [n])
  call c_f_pointer(s%conductivity, K, [n])
  call c_f_pointer(rates%pairs(1), heating, [n])

  do i = 1, n
    do j = 1, n
      if (i == j) cycle
      r_ij = 0
      r_ij(1:dims) = places(:, i) - places(:, j)
      do axis = 1, dims
        if (s%periodic(axis) == 0) cycle
        r_ij(axis) = r_ij(axis) - (s%upper(axis) - s%lower(axis))*anint(r_ij(axis)/(s%upper(axis) - s%lower(axis)))
      end do
      r = norm2(r_ij)
      if (r >= 2*s%smoothing_length) cycle
      heating(i) = heating(i) + mass(j)*(K(i) + K(j))/(rho(i)*rho(j))*(T(i) - T(j))*slope(r, s%smoothing_length, dims)
    end do
  end do

  if (s%walls > 0) then
    call c_f_pointer(s%wall, walls, [int(s%walls)])
    call c_f_pointer(rates%wall, wall_rates, [3, int(s%walls)])
    do w = 1, int(s%walls)
      associate (wall => walls(w))
        call c_f_pointer(wall_rates(1, w), of_wall, [n])
        call c_f_pointer(wall%particle, particle, [int(wall%contacts)])
        call c_f_pointer(wall%distance, distance, [int(wall%contacts)])
        call c_f_pointer(wall%face_weight, weight, [int(wall%contacts)])
        call c_f_pointer(wall%temperature, T_B, [int(wall%contacts)])
        call c_f_pointer(wall%conductivity, K_B, [int(wall%contacts)])
        ! Where the wall prescribes a flux and no temperature, its term is -2 F_B.S_i/rho_i.
        if (iand(wall%prescribes, reads_flux) /= 0 .and. iand(wall%prescribes, reads_temperature) == 0) then
          do axis = 1, dims
            call c_f_pointer(wall%flux(axis), F, [int(wall%contacts)])
            do c = 1, int(wall%contacts)
              i = particle(c) + 1  ! C counts from 0
              of_wall(i) = of_wall(i) - 2*F(c)*wall%outward_normal(axis)*weight(c)/rho(i)
            end do
          end do
          cycle
        end if
        do c = 1, int(wall%contacts)
          i = particle(c) + 1
          of_wall(i) = of_wall(i) + (K(i) + K_B(c))/rho(i)*(T_B(c) - T(i))/distance(c)*weight(c)
        end do
      end associate
    end do
  end if
  status = 0
end function
