-- The pipeline for VHDL: its component, and an entity that instantiates it.
-- Made by: [[ command ]]
--
-- The sources are SystemVerilog: a simulator or synthesiser of both languages binds the component to them by its name.
library ieee;
use ieee.std_logic_1164.all;

package [[ package ]] is

  -- Clock cycles from a request to its result, where nothing waits.
  constant LATENCY : positive := [[ latency ]];

  component [[ component ]] is
<%- if let Some(image) = image %>
    generic (
      ROM_FILE : string := "[[ image ]]"
    );
<%- endif %>
    port (
      clk_i       : in  std_logic;
      rst_i       : in  std_logic;  -- [[ reset ]]
      -- Request
      in_valid_i  : in  std_logic;
      in_ready_o  : out std_logic;
      address_i   : in  std_logic_vector([[ address ]] downto 0);
      x_i         : in  std_logic_vector([[ x ]] downto 0);  -- [[ x_format ]]
      -- Result
      out_valid_o : out std_logic;
      out_ready_i : in  std_logic;
      intensity_o : out std_logic_vector([[ intensity ]] downto 0);  -- [[ intensity_format ]]
      status_o    : out std_logic_vector([[ status ]] downto 0)
    );
  end component;

end package;

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.[[ package ]].all;

-- The same with numbers for address, x and intensity: their values are those of the formats times a power of two.
entity [[ entity ]] is
  port (
    clk_i       : in  std_logic;
    rst_i       : in  std_logic;
    in_valid_i  : in  std_logic;
    in_ready_o  : out std_logic;
    address_i   : in  unsigned([[ address ]] downto 0);
    x_i         : in  [[ x_type ]]([[ x ]] downto 0);
    out_valid_o : out std_logic;
    out_ready_i : in  std_logic;
    intensity_o : out unsigned([[ intensity ]] downto 0);
    status_o    : out std_logic_vector([[ status ]] downto 0)
  );
end entity;

architecture instance of [[ entity ]] is
  signal intensity : std_logic_vector([[ intensity ]] downto 0);
begin

  intensity_o <= unsigned(intensity);

  pipeline : [[ component ]]
    port map (
      clk_i       => clk_i,
      rst_i       => rst_i,
      in_valid_i  => in_valid_i,
      in_ready_o  => in_ready_o,
      address_i   => std_logic_vector(address_i),
      x_i         => std_logic_vector(x_i),
      out_valid_o => out_valid_o,
      out_ready_i => out_ready_i,
      intensity_o => intensity,
      status_o    => status_o
    );

end architecture;
